/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_read.h"

#include "app/scene/vector.h"

#include <lampion/probe.h>
#include <lampion/shade.h>

#include <string.h>

/* Irradiance is read at pixels so far apart, and interpolated between them; nearer where what they
 * show differs. */
enum { APART = 8, APART_LEAST = 2 };

/* How much the irradiance of such pixels may differ for others to be interpolated: all of them are
 * read where it changes faster, as where surfaces meet. */
static const float contrast = 0.2f;

/* A pixel of the tile that shows no surface to read. */
#define UNLISTED UINT16_MAX

/* The pixels of a rectangle that are read. */
typedef struct reading {
    const transfer_baked *baked;
    const transfer_view *views; /* of its layers */
    const render_tile *tile;    /* holds them, one after another */
    int width, height;
    size_t count;
    uint32_t pixels[RENDER_TILE_PIXELS]; /* in the planes */
    uint16_t number[RENDER_TILE_PIXELS]; /* of each pixel of the rectangle, or UNLISTED */
    bool known[RENDER_TILE_PIXELS];      /* read from receivers */
    bool found[RENDER_TILE_PIXELS];      /* interpolated */
    lmp_rgb irradiance[RENDER_TILE_PIXELS];
} reading;

/* Lists the pixels that show a surface of their own, and clears the planes of the others. */
static void list_pixels(const render_surfaces *s, const render_rectangle *pixels, reading *r) {
    r->width = pixels->width;
    r->height = pixels->height;
    r->count = 0;
    memset(r->known, 0, sizeof r->known);
    memset(r->found, 0, sizeof r->found);
    for (int i = 0; i < pixels->width * pixels->height; i++) {
        const int x = pixels->x + i % pixels->width, y = pixels->y + i / pixels->width;
        const size_t pixel = render_surfaces_at(s, x, y);
        r->number[i] = UNLISTED;
        if (render_surfaces_same(s, pixel))
            continue;
        if (render_surfaces_taken(s, pixel)) {
            render_set_color(s->bounced, pixel, render_color_at(s->first->bounced, pixel));
            continue;
        }
        if (s->seen[pixel] < RENDER_SEES_LIGHT) {
            r->number[i] = (uint16_t)r->count;
            r->pixels[r->count++] = (uint32_t)pixel;
        } else
            render_set_color(s->bounced, pixel, (lmp_rgb) { 0, 0, 0 });
    }
}

/* --- irradiance ------------------------------------------------------------------------------- */

static lmp_vec3 vector_at(float *const planes[3], size_t i) {
    return vec(planes[0][i], planes[1][i], planes[2][i]);
}

/* Returns the irradiance of a point, from receivers, or from surfels where there is none. */
static lmp_rgb read_point(const reading *r, lmp_vec3 point, lmp_vec3 normal) {
    static const int order[] = { TRANSFER_RECEIVERS, TRANSFER_SURFELS };
    for (int i = 0; i < TRANSFER_LAYERS; i++) {
        const uint32_t nearest = transfer_nearest(&r->views[order[i]], point, normal);
        if (nearest != LMP_TRANSFER_NONE)
            return lmp_transfer_irradiance(r->baked->layers[order[i]].transfer, nearest, point,
                                           normal);
    }
    return (lmp_rgb) { 0, 0, 0 };
}

/* Returns the irradiance of a listed pixel. */
static lmp_rgb read_pixel(reading *r, size_t i) {
    if (!r->known[i]) {
        r->irradiance[i] =
            read_point(r, vector_at(r->tile->position, i), vector_at(r->tile->normal, i));
        r->known[i] = true;
    }
    return r->irradiance[i];
}

/* Whether a point lies on the same smooth surface as listed pixel i, no further away than its
 * surfels. */
static bool is_beside(const reading *r, size_t i, lmp_vec3 point, lmp_vec3 normal) {
    const float spacing = r->views[TRANSFER_SURFELS].cells->surfels->spacing;
    const lmp_vec3 own = vector_at(r->tile->normal, i);
    const lmp_vec3 away = vec_sub(point, vector_at(r->tile->position, i));
    return vec_dot(away, away) <= spacing * spacing &&
           fabsf(vec_dot(away, own)) <= 0.1f * spacing && vec_dot(own, normal) >= 0.95f;
}

static bool are_far(float a, float b) {
    return fabsf(a - b) > contrast * (a > b ? a : b);
}

static bool differ(lmp_rgb a, lmp_rgb b) {
    return are_far(a.r, b.r) || are_far(a.g, b.g) || are_far(a.b, b.b);
}

/* A square of pixels around one, and which of its corners lie on the same surface as that one. */
typedef struct square {
    int count;
    size_t corner[4]; /* as listed */
    float weight[4];  /* by how near the pixel is to it */
} square;

/* Returns how near a pixel is to the last pixel of its square along an axis, 0 … 1, where a square
 * has its first pixel at *first; its size is a power of 2. */
static float find_side(int at, int size, int end, int *first, int *last) {
    *first = at & -size;
    *last = *first + size < end ? *first + size : end - 1;
    return *last > *first ? (float)(at - *first) / (float)(*last - *first) : 0;
}

static square find_square(const reading *r, int x, int y, int size) {
    const size_t pixel = r->number[y * r->width + x];
    int left, right, top, bottom;
    const float along = find_side(x, size, r->width, &left, &right),
                down = find_side(y, size, r->height, &top, &bottom);
    square q = { .count = 0 };
    for (int i = 0; i < 4; i++) {
        const int column = i & 1 ? right : left, row = i & 2 ? bottom : top;
        const uint16_t corner = r->number[row * r->width + column];
        if (corner != UNLISTED && is_beside(r, pixel, vector_at(r->tile->position, corner),
                                            vector_at(r->tile->normal, corner))) {
            q.weight[q.count] = (i & 1 ? along : 1 - along) * (i & 2 ? down : 1 - down);
            q.corner[q.count++] = corner;
        }
    }
    return q;
}

/* Interpolates between the corners of a square; returns false if they differ too much. */
static bool interpolate(reading *r, const square *q, lmp_rgb *irradiance) {
    const lmp_rgb first = read_pixel(r, q->corner[0]);
    lmp_rgb sum = { 0, 0, 0 };
    float weights = 0;
    for (int i = 0; i < q->count; i++) {
        const lmp_rgb e = read_pixel(r, q->corner[i]);
        const float weight = q->weight[i] + 1e-3f; /* should only far corners be on the surface */
        if (differ(first, e))
            return false;
        sum.r += weight * e.r;
        sum.g += weight * e.g;
        sum.b += weight * e.b;
        weights += weight;
    }
    *irradiance = rgb_scale(sum, 1 / weights);
    return true;
}

/* Finds the irradiance of a listed pixel: in the largest square of which two corners are on its
 * surface, or one of the smallest. */
static lmp_rgb irradiance_of(reading *r, int x, int y) {
    const size_t pixel = r->number[y * r->width + x];
    lmp_rgb irradiance;
    for (int size = APART; size >= APART_LEAST && !r->known[pixel]; size /= 2) {
        const square q = find_square(r, x, y, size);
        if (q.count >= (size > APART_LEAST ? 2 : 1) && interpolate(r, &q, &irradiance) &&
            !r->known[pixel])
            return irradiance;
    }
    return read_pixel(r, pixel);
}

static lmp_rgb mix(lmp_rgb a, lmp_rgb b, float part) {
    return (lmp_rgb) { a.r + part * (b.r - a.r), a.g + part * (b.g - a.g),
                       a.b + part * (b.b - a.b) };
}

/* Interpolates the pixels of a square's row that lie on the surface of one of its corners. */
static void fill_row(reading *r, int y, int left, lmp_rgb first, lmp_rgb last, size_t corner) {
    const lmp_vec3 point = vector_at(r->tile->position, corner),
                   normal = vector_at(r->tile->normal, corner);
    for (int x = left; x < left + APART && x < r->width; x++) {
        int begin, end;
        const uint16_t i = r->number[y * r->width + x];
        if (i == UNLISTED || r->known[i] || !is_beside(r, i, point, normal))
            continue;
        r->irradiance[i] = mix(first, last, find_side(x, APART, r->width, &begin, &end));
        r->found[i] = true;
    }
}

/* Fills a square whose corners lie on one surface and differ little. Most pixels are so compared
 * with one corner alone. */
static void fill_square(reading *r, int left, int top) {
    lmp_rgb e[4];
    if (r->number[top * r->width + left] == UNLISTED)
        return;
    const square q = find_square(r, left, top, APART);
    for (int i = 0; i < q.count; i++) {
        e[i] = read_pixel(r, q.corner[i]);
        if (differ(e[0], e[i]))
            return;
    }
    for (int y = top; q.count == 4 && y < top + APART && y < r->height; y++) {
        int begin, end;
        const float down = find_side(y, APART, r->height, &begin, &end);
        fill_row(r, y, left, mix(e[0], e[2], down), mix(e[1], e[3], down), q.corner[0]);
    }
}

/* Takes a listed pixel's irradiance from a pixel of the first sample that shows the same surface,
 * itself or one next to it. */
static bool take_first(reading *r, const render_surfaces *s, const render_rectangle *pixels, int x,
                       int y) {
    static const int beside[5][2] = { { 0, 0 }, { -1, 0 }, { 1, 0 }, { 0, -1 }, { 0, 1 } };
    const render_surfaces *first = s->first;
    const size_t i = r->number[y * r->width + x];
    for (int k = 0; first && k < 5; k++) {
        const int column = x + beside[k][0], row = y + beside[k][1];
        if (column < 0 || column >= r->width || row < 0 || row >= r->height)
            continue;
        const size_t at = render_surfaces_at(s, pixels->x + column, pixels->y + row);
        if (first->seen[at] < RENDER_SEES_LIGHT &&
            is_beside(r, i, vector_at(first->position, at), vector_at(first->normal, at))) {
            r->irradiance[i] = render_color_at(first->arrived, at);
            return true;
        }
    }
    return false;
}

/* Finds the irradiance of all listed pixels. */
static void find_irradiance(reading *r, const render_surfaces *s, const render_rectangle *pixels) {
    for (int y = 0; y < r->height && !s->first; y += APART)
        for (int x = 0; x < r->width; x += APART)
            fill_square(r, x, y);
    for (int y = 0; y < r->height; y++)
        for (int x = 0; x < r->width; x++) {
            const uint16_t i = r->number[y * r->width + x];
            if (i != UNLISTED && !r->found[i] && !take_first(r, s, pixels, x, y))
                r->irradiance[i] = irradiance_of(r, x, y);
        }
}

/* --- what surfaces reflect of it -------------------------------------------------------------- */

/* Computes the radiance that the listed pixels reflect of an even light whose irradiance is pi. */
static void reflect(const render_surfaces *s, const reading *r, lmp_rgb *reflected) {
    static const float white[3] = { 3.5449077f, 3.5449077f, 3.5449077f }; /* 2 sqrt(pi) */
    const lmp_environment even = { white, 1 };
    const render_frame *frame = s->frame;
    const lmp_shade_settings settings = { .method = method_table[frame->method].method,
                                          .bands = frame->bands,
                                          .window = frame->window,
                                          .lobe = frame->lobes };
    const lmp_surfaces surfaces = render_tile_surfaces(r->tile, s->layered);
    lmp_shade_environment_n(&settings, &surfaces, r->count, &even, lmp_rgb_array_of(reflected));
}

void transfer_read(const transfer_baked *baked, const transfer_view *views,
                   const render_surfaces *s, const render_rectangle *pixels, render_tile *tile) {
    reading r = { .baked = baked, .views = views, .tile = tile };
    lmp_rgb reflected[RENDER_TILE_PIXELS];
    list_pixels(s, pixels, &r);
    if (r.count == 0)
        return;
    render_surfaces_pick(s, r.pixels, r.count, tile);
    find_irradiance(&r, s, pixels);
    reflect(s, &r, reflected);
    for (size_t i = 0; i < r.count; i++) {
        const size_t pixel = r.pixels[i];
        const lmp_rgb e = r.irradiance[i];
        render_set_color(s->arrived, pixel, e);
        render_set_color(s->bounced, pixel,
                         (lmp_rgb) { reflected[i].r * e.r / PI, reflected[i].g * e.g / PI,
                                     reflected[i].b * e.b / PI });
    }
}
