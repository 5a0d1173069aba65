/* SPDX-License-Identifier: MIT */
/* The G-buffer on the host: read as it is stored, decoded a tile at a time (pixel.glsl does the
 * same). */
#include "app/render/gl/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- reading ---------------------------------------------------------------------------------- */

static bool allocate(gpu_gbuffer *g, int width, int height, bool layered, cli_error *error) {
    const size_t count = (size_t)width * (size_t)height;
    gpu_gbuffer_free(g);
    g->depth = malloc(count * sizeof *g->depth);
    g->base_metallic = malloc(count * sizeof *g->base_metallic);
    g->normal = malloc(count * sizeof *g->normal);
    g->roughness_kind = malloc(count * sizeof *g->roughness_kind);
    g->emission = malloc(count * sizeof *g->emission);
    g->layers = malloc(count * sizeof *g->layers);
    g->rgba = malloc(count * sizeof *g->rgba);
    if (layered) {
        g->coat = malloc(count * sizeof *g->coat);
        g->tint = malloc(count * sizeof *g->tint);
        g->sheen = malloc(count * sizeof *g->sheen);
    }
    if (!g->depth || !g->base_metallic || !g->normal || !g->roughness_kind || !g->emission ||
        !g->layers || !g->rgba || (layered && (!g->coat || !g->tint || !g->sheen))) {
        gpu_gbuffer_free(g);
        return cli_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
    }
    g->width = width;
    g->height = height;
    return true;
}

void gpu_gbuffer_free(gpu_gbuffer *g) {
    free(g->depth);
    free(g->base_metallic);
    free(g->normal);
    free(g->roughness_kind);
    free(g->emission);
    free(g->layers);
    free(g->coat);
    free(g->tint);
    free(g->sheen);
    free(g->rgba);
    memset(g, 0, sizeof *g);
}

bool gpu_gbuffer_read(const gpu_renderer *r, const shared_frame *block, const render_frame *frame,
                      gpu_gbuffer *g, cli_error *error) {
    const size_t count = (size_t)r->width * (size_t)r->height;
    if ((g->width != r->width || g->height != r->height) &&
        !allocate(g, r->width, r->height, r->mesh.layered, error))
        return false;
    const struct {
        GLuint texture;
        GLenum format, type;
        size_t size;
        void *to;
    } planes[] = {
        { r->depth, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof *g->depth, g->depth },
        { r->attachments[0], GL_RGBA, GL_UNSIGNED_SHORT, sizeof *g->base_metallic,
          g->base_metallic },
        { r->attachments[1], GL_RG, GL_UNSIGNED_SHORT, sizeof *g->normal, g->normal },
        { r->attachments[2], GL_RG, GL_UNSIGNED_SHORT, sizeof *g->roughness_kind,
          g->roughness_kind },
        { r->attachments[3], GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV, sizeof *g->emission,
          g->emission },
        { r->attachments[4], GL_RG, GL_UNSIGNED_BYTE, sizeof *g->layers, g->layers },
        { r->attachments[5], GL_RGBA, GL_UNSIGNED_SHORT, sizeof *g->coat, g->coat },
        { r->attachments[6], GL_RGBA, GL_UNSIGNED_BYTE, sizeof *g->tint, g->tint },
        { r->attachments[7], GL_RGBA, GL_UNSIGNED_BYTE, sizeof *g->sheen, g->sheen },
    };
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (size_t i = 0; i < sizeof planes / sizeof *planes && planes[i].to; i++) {
        if (count * planes[i].size > INT32_MAX)
            return cli_fail(error, NULL, "an image of %d x %d is too large to read back", r->width,
                            r->height);
        glGetTextureImage(planes[i].texture, 0, planes[i].format, planes[i].type,
                          (GLsizei)(count * planes[i].size), planes[i].to);
    }
    g->block = *block;
    g->frame = frame;
    g->mesh = &r->mesh;
    g->tables = r->tables;
    g->brdfs = r->brdfs;
    g->fibers = r->fibers;
    g->environment = r->environment;
    return true;
}

/* --- a tile ----------------------------------------------------------------------------------- */

bool render_tile_create(int pixels, render_tile *row) {
    const size_t count = (size_t)pixels;
    memset(row, 0, sizeof *row);
    float *memory = malloc(count * (sizeof *row->material + 16 * sizeof(float) + 1));
    if (!memory)
        return false;
    row->material = (lmp_material *)(void *)memory;
    memory = (float *)(void *)(row->material + count);
    float **planes[] = { row->position, row->normal, row->view, row->coat_normal, row->emission };
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++)
        for (int c = 0; c < 3; c++, memory += count)
            planes[i][c] = memory;
    row->ambient = memory;
    row->kind = (unsigned char *)(memory + count);
    return true;
}

void render_tile_free(render_tile *row) {
    free(row->material);
}

/* Unsigned floats of 5 bits of exponent, and 6 or 5 of mantissa. */
static float small_float(uint32_t bits, int mantissa) {
    const uint32_t fraction = bits & ((1u << mantissa) - 1), exponent = bits >> mantissa & 31;
    const float unit = 1.0f / (float)(1u << mantissa);
    return exponent == 0 ? ldexpf((float)fraction * unit, -14)
                         : ldexpf(1 + (float)fraction * unit, (int)exponent - 15);
}

static lmp_rgb decode_emission(uint32_t bits) {
    if (bits == 0)
        return (lmp_rgb) { 0, 0, 0 };
    return (lmp_rgb) { small_float(bits & 2047, 6), small_float(bits >> 11 & 2047, 6),
                       small_float(bits >> 22, 5) };
}

lmp_rgb gpu_gbuffer_emission(const gpu_gbuffer *g, size_t pixel) {
    return decode_emission(g->emission[pixel]);
}

static lmp_rgb light_of(const gpu_gbuffer *g, unsigned index) {
    return index < g->frame->light_count ? g->frame->lights[index].emitter.radiance
                                         : (lmp_rgb) { 0, 0, 0 };
}

/* Pixels in a row of the image, and where they come to in the arrays of a render_tile. */
typedef struct gpu_span {
    int x, y, count;
    size_t at;
} gpu_span;

/* What is seen past everything. */
static lmp_rgb decode_nothing(const gpu_gbuffer *g, size_t x, const render_tile *row) {
    const float *background = g->block.background;
    const float away[3] = { -row->view[0][x], -row->view[1][x], -row->view[2][x] };
    if (g->block.surroundings[2] > 0)
        return environment_seen(g->environment, away);
    return (lmp_rgb) { background[0], background[1], background[2] };
}

static size_t first_pixel(const gpu_gbuffer *g, const gpu_span *span) {
    return (size_t)span->y * (size_t)g->width + (size_t)span->x;
}

/* Of the pixels of a row the first ray, and what a column adds. */
typedef struct gpu_rays {
    float from[3], left[3], aside[3], right[3], across, start;
} gpu_rays;

static gpu_rays rays_of(const gpu_gbuffer *g, const gpu_span *span) {
    const shared_frame *b = &g->block;
    const float v = ((float)span->y + 0.5f) / b->size_lights[1] * 2 - 1 + b->jitter[1];
    const float parallel = b->forward[3], spread = 1 - parallel;
    gpu_rays rays = { .across = 2 / b->size_lights[0] };
    rays.start = 0.5f * rays.across - 1 + b->jitter[0];
    for (int i = 0; i < 3; i++) {
        rays.from[i] = b->eye[i] + b->down[i] * v * parallel;
        rays.left[i] = b->forward[i] + b->down[i] * v * spread;
        rays.aside[i] = b->right[i] * parallel;
        rays.right[i] = b->right[i] * spread;
    }
    return rays;
}

/* Positions of every pixel, as camera.glsl has them; what is no surface is nonsense. */
static void decode_positions(const gpu_gbuffer *g, const gpu_span *span, const render_tile *row) {
    const gpu_rays r = rays_of(g, span);
    const float *restrict depth = g->depth + first_pixel(g, span);
    float *restrict px = row->position[0] + span->at, *restrict py = row->position[1] + span->at;
    float *restrict pz = row->position[2] + span->at;
    const float parallel = g->block.forward[3], scale = g->block.eye[3];
    const int first = span->x, count = span->count;
#pragma omp simd
    for (int x = 0; x < count; x++) {
        const float u = (float)(first + x) * r.across + r.start;
        const float distance = parallel > 0 ? 2 * scale * (1 - depth[x]) : scale / depth[x];
        px[x] = r.from[0] + r.aside[0] * u + (r.left[0] + r.right[0] * u) * distance;
        py[x] = r.from[1] + r.aside[1] * u + (r.left[1] + r.right[1] * u) * distance;
        pz[x] = r.from[2] + r.aside[2] * u + (r.left[2] + r.right[2] * u) * distance;
    }
}

static void decode_views(const gpu_gbuffer *g, const gpu_span *span, const render_tile *row) {
    const gpu_rays r = rays_of(g, span);
    float *restrict vx = row->view[0] + span->at, *restrict vy = row->view[1] + span->at;
    float *restrict vz = row->view[2] + span->at;
    const int first = span->x, count = span->count;
#pragma omp simd
    for (int x = 0; x < count; x++) {
        const float u = (float)(first + x) * r.across + r.start;
        const float rx = r.left[0] + r.right[0] * u, ry = r.left[1] + r.right[1] * u;
        const float rz = r.left[2] + r.right[2] * u;
        const float back = -1 / sqrtf(rx * rx + ry * ry + rz * rz);
        vx[x] = rx * back;
        vy[x] = ry * back;
        vz[x] = rz * back;
    }
}

/* Octahedral: where z < 0 the triangles are folded outwards. */
static inline void decode_normal(uint16_t u, uint16_t v, size_t i, float *const n[3]) {
    const float p = (float)u * (2 / 65535.0f) - 1, q = (float)v * (2 / 65535.0f) - 1;
    const float z = 1 - fabsf(p) - fabsf(q), fold = (fabsf(z) - z) * 0.5f;
    const float w = p - copysignf(fold, p), h = q - copysignf(fold, q);
    const float scale = 1 / sqrtf(w * w + h * h + z * z);
    n[0][i] = w * scale;
    n[1][i] = h * scale;
    n[2][i] = z * scale;
}

static void decode_normals(const gpu_gbuffer *g, const gpu_span *span, const render_tile *row) {
    const gpu_pair16 *restrict normal = g->normal + first_pixel(g, span);
    float *const to[3] = { row->normal[0] + span->at, row->normal[1] + span->at,
                           row->normal[2] + span->at };
    const size_t count = (size_t)span->count;
#pragma omp simd
    for (size_t i = 0; i < count; i++)
        decode_normal(normal[i].u, normal[i].v, i, to);
}

static float unit(uint16_t stored) {
    return (float)stored / 65535;
}

/* Of three bytes, each a root. */
static lmp_rgb color_of(const uint8_t *root) {
    return (lmp_rgb) { (float)(root[0] * root[0]) / 65025, (float)(root[1] * root[1]) / 65025,
                       (float)(root[2] * root[2]) / 65025 };
}

/* Roots of base colors and metallic, then the roughness: of every pixel of a span, for the
 * quotients are then taken several at once. */
enum { UNITS = 64 };
typedef struct gpu_units {
    float base[4 * UNITS], rough[2 * UNITS];
} gpu_units;

static void decode_units(const gpu_gbuffer *g, size_t pixel, size_t count, gpu_units *units) {
    const uint16_t *restrict base = (const void *)&g->base_metallic[pixel];
    const uint16_t *restrict rough = (const void *)&g->roughness_kind[pixel];
    for (size_t i = 0; i < 4 * count; i++)
        units->base[i] = unit(base[i]);
    for (size_t i = 0; i < 2 * count; i++)
        units->rough[i] = unit(rough[i]);
}

/* Of a surface, without its colors. In place, for it is large. */
static void decode_reflector(const gpu_gbuffer *g, size_t pixel, lmp_material *material) {
    const int kind = g->roughness_kind[pixel].v;
    const bool layered = gpu_mesh_is_layered(g->mesh, kind);
    const lmp_rgb tint = layered ? color_of(g->tint[pixel]) : (lmp_rgb) { 1, 1, 1 };
    gpu_mesh_material(g->mesh, g->tables, g->brdfs, kind, (float)g->layers[pixel].v / 255, tint,
                      material);
    if (layered) {
        const uint8_t *sheen = g->sheen[pixel];
        material->coat = (lmp_coat) { unit(g->coat[pixel].weight), unit(g->coat[pixel].roughness) };
        if (sheen[0] || sheen[1] || sheen[2])
            material->fibers = (lmp_fibers) { color_of(sheen), (float)sheen[3] / 255, g->fibers };
    }
}

/* Whether a pixel has what the one before has, but for colors; that is a surface's, too. */
static bool is_alike(const gpu_gbuffer *g, size_t pixel) {
    return !g->coat && g->roughness_kind[pixel].v == g->roughness_kind[pixel - 1].v &&
           g->layers[pixel].v == g->layers[pixel - 1].v;
}

/* `i` in the units. Neighbors are often alike, and `reflector` is what the one before has. */
static void decode_material(const gpu_gbuffer *g, size_t pixel, const gpu_units *units, size_t i,
                            lmp_material *reflector, lmp_material *material) {
    const float *base = &units->base[4 * i];
    if (i == 0 || !is_alike(g, pixel))
        decode_reflector(g, pixel, reflector);
    *material = *reflector;
    material->base_color = (lmp_rgb) { base[0] * base[0], base[1] * base[1], base[2] * base[2] };
    material->metallic = base[3];
    material->roughness = units->rough[2 * i];
}

static void decode_coat_normal(const gpu_gbuffer *g, size_t pixel, size_t x,
                               const render_tile *row) {
    if (row->material[x].coat.weight > 0)
        decode_normal(g->coat[pixel].u, g->coat[pixel].v, x, row->coat_normal);
    else
        for (int c = 0; c < 3; c++)
            row->coat_normal[c][x] = row->normal[c][x];
}

size_t gpu_gbuffer_surfaces(const gpu_gbuffer *g, int y, render_tile *row) {
    const gpu_span span = { 0, y, g->width, 0 };
    const gpu_pair16 *of = g->roughness_kind + first_pixel(g, &span);
    size_t count = 0;
    decode_positions(g, &span, row);
    for (int x = 0; x < g->width; x++) {
        for (int c = 0; c < 3; c++)
            row->position[c][count] = row->position[c][x];
        count += of[x].v >= SHARED_KIND_SURFACE;
    }
    return count;
}

bool gpu_gbuffer_is_layered(const gpu_gbuffer *g) {
    return g->coat;
}

int gpu_gbuffer_sample(const gpu_gbuffer *g) {
    return g->sample;
}

static lmp_rgb emission_of(const gpu_gbuffer *g, int kind, size_t pixel, size_t x,
                           const render_tile *row) {
    return kind == SHARED_KIND_NONE    ? decode_nothing(g, x, row)
           : kind == SHARED_KIND_LIGHT ? light_of(g, g->normal[pixel].u)
                                       : decode_emission(g->emission[pixel]);
}

/* `count` pixels, into the arrays from `at` on. */
static void decode_pixels(const gpu_gbuffer *g, size_t first, size_t count, size_t at,
                          render_tile *row) {
    gpu_units units;
    lmp_material reflector;
    decode_units(g, first, count, &units);
    for (size_t i = 0; i < count; i++) {
        const size_t pixel = first + i, x = at + i;
        const int kind = g->roughness_kind[pixel].v;
        const lmp_rgb emission = emission_of(g, kind, pixel, x, row);
        row->emission[0][x] = emission.r;
        row->emission[1][x] = emission.g;
        row->emission[2][x] = emission.b;
        row->kind[x] = (unsigned char)(kind < SHARED_KIND_SURFACE ? kind : RENDER_SURFACE);
        if (kind < SHARED_KIND_SURFACE)
            continue;
        decode_material(g, pixel, &units, i, &reflector, &row->material[x]);
        row->ambient[x] = (float)g->layers[pixel].u / 255;
        if (g->coat)
            decode_coat_normal(g, pixel, x, row);
    }
}

static void decode_span(const gpu_gbuffer *g, const gpu_span *span, render_tile *row) {
    const size_t pixel = first_pixel(g, span), count = (size_t)span->count;
    decode_positions(g, span, row);
    decode_views(g, span, row);
    decode_normals(g, span, row);
    for (size_t i = 0; i < count; i += UNITS)
        decode_pixels(g, pixel + i, count - i < UNITS ? count - i : UNITS, span->at + i, row);
}

void gpu_gbuffer_tile(const gpu_gbuffer *g, int x, int y, int width, int height, render_tile *row) {
    for (int i = 0; i < height; i++) {
        const gpu_span span = { x, y + i, width, (size_t)i * (size_t)width };
        decode_span(g, &span, row);
    }
}

void gpu_gbuffer_row(const gpu_gbuffer *g, int y, render_tile *row) {
    gpu_gbuffer_tile(g, 0, y, g->width, 1, row);
}
