/* SPDX-License-Identifier: MIT */
/* A lobe is drawn as a mesh of small quadrilaterals of one color each, into a canvas of OVERSAMPLE²
 * samples per pixel with depth. */
#include "app/image/figure.h"

#include <math.h>
#include <stdlib.h>

#define OVERSAMPLE 4
#define ELEVATION  0.35f /* of the viewer above the horizon, radians */
#define AZIMUTH    0.60f /* of the lobe's rotation around z, radians */
#define FILLED     0.47f /* of the box, for a radius of 1 */

#define PI 3.14159265f

typedef struct sample {
    float depth; /* grows toward the viewer */
    lmp_rgb color;
} sample;

typedef struct canvas {
    int width, height; /* in samples */
    float scale;       /* samples per radius of 1 */
    sample *samples;
} canvas;

/* A corner of the mesh. */
typedef struct corner {
    lmp_vec3 position; /* x to the right, y up, z toward the viewer; relative to the center */
    float radius;
} corner;

static lmp_vec3 subtract(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.x - b.x, a.y - b.y, a.z - b.z };
}

static float dot(lmp_vec3 a, lmp_vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static lmp_vec3 cross(lmp_vec3 a, lmp_vec3 b) {
    return (lmp_vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static lmp_vec3 to_view(lmp_vec3 p) {
    const float x = cosf(AZIMUTH) * p.x + sinf(AZIMUTH) * p.y;
    const float y = cosf(AZIMUTH) * p.y - sinf(AZIMUTH) * p.x;
    return (lmp_vec3) { x, sinf(ELEVATION) * y + cosf(ELEVATION) * p.z,
                        sinf(ELEVATION) * p.z - cosf(ELEVATION) * y };
}

/* Returns a color lit by a key light with its highlight from above left and a dim sky, darkened
 * toward the center, where the lobes meet. `normal` need not be unit. */
static lmp_rgb shade(lmp_vec3 normal, float distance, lmp_rgb color) {
    static const lmp_vec3 key = { -0.41f, 0.62f, 0.67f }, half_vector = { -0.225f, 0.34f, 0.913f };
    const float length = sqrtf(dot(normal, normal));
    const float facing = fmaxf(dot(normal, key) / length, 0.0f);
    const float sky = 0.5f + 0.5f * normal.y / length;
    const float open = 0.35f + 0.65f * fminf(1.0f, 2.0f * distance);
    const float light = open * (0.85f * facing + 0.28f * sky + 0.10f);
    const float gloss = 0.30f * powf(fmaxf(dot(normal, half_vector) / length, 0.0f), 40.0f);
    return (lmp_rgb) { color.r * light + gloss, color.g * light + gloss, color.b * light + gloss };
}

/* --- mesh to samples -------------------------------------------------------------------------- */

static float edge(lmp_vec3 a, lmp_vec3 b, float x, float y) {
    return (b.x - a.x) * (y - a.y) - (b.y - a.y) * (x - a.x);
}

static float least3(float a, float b, float c) {
    return fminf(a, fminf(b, c));
}

static float most3(float a, float b, float c) {
    return fmaxf(a, fmaxf(b, c));
}

static void draw_triangle(canvas *c, lmp_vec3 p, lmp_vec3 q, lmp_vec3 r, lmp_rgb color) {
    const float area = edge(p, q, r.x, r.y);
    if (area == 0.0f)
        return;
    const int left = (int)fmaxf(ceilf(least3(p.x, q.x, r.x) - 0.5f), 0.0f);
    const int top = (int)fmaxf(ceilf(least3(p.y, q.y, r.y) - 0.5f), 0.0f);
    const int right = (int)fminf(most3(p.x, q.x, r.x) + 0.5f, (float)c->width);
    const int bottom = (int)fminf(most3(p.y, q.y, r.y) + 0.5f, (float)c->height);
    for (int j = top; j < bottom; j++)
        for (int i = left; i < right; i++) {
            const float x = (float)i + 0.5f, y = (float)j + 0.5f;
            const float u = edge(q, r, x, y) / area, v = edge(r, p, x, y) / area;
            if (!(u >= 0.0f && v >= 0.0f && u + v <= 1.0f))
                continue;
            const float depth = u * p.z + v * q.z + (1.0f - u - v) * r.z;
            sample *const s = &c->samples[(size_t)j * (size_t)c->width + (size_t)i];
            if (depth > s->depth)
                *s = (sample) { depth, color };
        }
}

static lmp_vec3 to_canvas(const canvas *c, lmp_vec3 p) {
    return (lmp_vec3) { 0.5f * (float)c->width + c->scale * p.x,
                        0.5f * (float)c->height - c->scale * p.y, p.z };
}

static void draw_quad(canvas *c, const corner *above, const corner *below,
                      const figure_lobe *lobe) {
    const lmp_vec3 a = above[0].position, b = above[1].position, d = below[0].position,
                   e = below[1].position;
    /* diagonals, because at the poles one side of the quad has length 0 */
    lmp_vec3 normal = cross(subtract(e, a), subtract(b, d));
    if (dot(normal, normal) == 0.0f)
        return;
    const lmp_vec3 middle = { 0.25f * (a.x + b.x + d.x + e.x), 0.25f * (a.y + b.y + d.y + e.y),
                              0.25f * (a.z + b.z + d.z + e.z) };
    if (dot(normal, middle) < 0.0f) /* a star-shaped surface: outward is off the center */
        normal = (lmp_vec3) { -normal.x, -normal.y, -normal.z };
    const float sign = above[0].radius + above[1].radius + below[0].radius + below[1].radius;
    const lmp_rgb color =
        shade(normal, sqrtf(dot(middle, middle)), sign < 0.0f ? lobe->negative : lobe->positive);
    draw_triangle(c, to_canvas(c, a), to_canvas(c, b), to_canvas(c, d), color);
    draw_triangle(c, to_canvas(c, b), to_canvas(c, d), to_canvas(c, e), color);
}

static void fill_row(const figure_lobe *lobe, int row, int rows, corner *corners) {
    const float theta = PI * (float)row / (float)rows;
    for (int j = 0; j <= 2 * rows; j++) {
        const float phi = PI * (float)j / (float)rows;
        const lmp_vec3 direction = { sinf(theta) * cosf(phi), sinf(theta) * sinf(phi),
                                     cosf(theta) };
        const float radius = lobe->radius(direction, lobe->user), size = fabsf(radius);
        corners[j] = (corner) {
            to_view((lmp_vec3) { size * direction.x, size * direction.y, size * direction.z }),
            radius,
        };
    }
}

/* Averages the samples of each pixel and composites them over the image. */
static void resolve(const canvas *c, image *pixels, figure_box box) {
    for (int y = 0; y < box.height; y++)
        for (int x = 0; x < box.width; x++) {
            const int px = box.x + x, py = box.y + y;
            if (px < 0 || py < 0 || px >= pixels->width || py >= pixels->height)
                continue;
            float *const rgb = pixels->rgb + 3 * ((size_t)py * (size_t)pixels->width + (size_t)px);
            float sum[3] = { 0.0f, 0.0f, 0.0f };
            for (int j = 0; j < OVERSAMPLE; j++)
                for (int i = 0; i < OVERSAMPLE; i++) {
                    const size_t first = (size_t)(y * OVERSAMPLE + j) * (size_t)c->width;
                    const sample *const s = &c->samples[first + (size_t)(x * OVERSAMPLE + i)];
                    const bool drawn = s->depth > -INFINITY;
                    sum[0] += drawn ? s->color.r : rgb[0];
                    sum[1] += drawn ? s->color.g : rgb[1];
                    sum[2] += drawn ? s->color.b : rgb[2];
                }
            for (int i = 0; i < 3; i++)
                rgb[i] = sum[i] / (OVERSAMPLE * OVERSAMPLE);
        }
}

bool figure_draw_lobe(image *pixels, figure_box box, const figure_lobe *lobe, base_error *error) {
    const int side = box.width < box.height ? box.width : box.height;
    const int rows = 2 * side > 16 ? 2 * side : 16; /* quads cover two or three samples */
    canvas c = { .width = box.width * OVERSAMPLE,
                 .height = box.height * OVERSAMPLE,
                 .scale = FILLED * (float)(side * OVERSAMPLE) };
    const size_t count = (size_t)c.width * (size_t)c.height, corners = 2 * (size_t)rows + 1;
    c.samples = malloc(count * sizeof *c.samples);
    corner *const strip = malloc(2 * corners * sizeof *strip);
    if (!c.samples || !strip) {
        free(c.samples);
        free(strip);
        return base_fail(error, NULL, "out of memory for a lobe of %d x %d", box.width, box.height);
    }
    for (size_t i = 0; i < count; i++)
        c.samples[i].depth = -INFINITY;
    fill_row(lobe, 0, rows, strip);
    for (int row = 1; row <= rows; row++) {
        corner *const above = strip + (row % 2 ? 0 : corners);
        corner *const below = strip + (row % 2 ? corners : 0);
        fill_row(lobe, row, rows, below);
        for (size_t j = 0; j + 1 < corners; j++)
            draw_quad(&c, above + j, below + j, lobe);
    }
    resolve(&c, pixels, box);
    free(strip);
    free(c.samples);
    return true;
}
