/* SPDX-License-Identifier: MIT */
/* The G-buffer on the CPU: read as it is stored, decoded to surfaces (pixel.glsl does the same). */
#include "app/render/gl/gbuffer.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* --- reading ---------------------------------------------------------------------------------- */

static bool allocate(gpu_gbuffer *g, int width, int height, const render_materials *materials,
                     base_error *error) {
    const bool layered = materials->layered;
    const size_t count = (size_t)width * (size_t)height;
    gpu_gbuffer_free(g);
    g->depth = malloc(count * sizeof *g->depth);
    g->base_metallic = malloc(count * sizeof *g->base_metallic);
    g->normal = malloc(count * sizeof *g->normal);
    g->roughness_kind = malloc(count * sizeof *g->roughness_kind);
    g->emission = malloc(count * sizeof *g->emission);
    g->weights = malloc(count * sizeof *g->weights);
    g->rgba = malloc(count * sizeof *g->rgba);
    if (layered) {
        g->coat = malloc(count * sizeof *g->coat);
        g->tint = malloc(count * sizeof *g->tint);
        g->sheen = malloc(count * sizeof *g->sheen);
    }
    if (!g->depth || !g->base_metallic || !g->normal || !g->roughness_kind || !g->emission ||
        !g->weights || !g->rgba || (layered && (!g->coat || !g->tint || !g->sheen)) ||
        !render_surfaces_create(width, height, materials, &g->surfaces)) {
        gpu_gbuffer_free(g);
        return base_fail(error, NULL, "out of memory for an image of %d x %d", width, height);
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
    free(g->weights);
    free(g->coat);
    free(g->tint);
    free(g->sheen);
    free(g->rgba);
    render_surfaces_free(&g->surfaces);
    memset(g, 0, sizeof *g);
}

static bool read_attachments(const gpu_targets *t, gpu_gbuffer *g, base_error *error) {
    const size_t count = (size_t)t->width * (size_t)t->height;
    const struct {
        GLuint texture;
        GLenum format, type;
        size_t size;
        void *to;
    } planes[] = {
        { t->depth, GL_DEPTH_COMPONENT, GL_FLOAT, sizeof *g->depth, g->depth },
        { t->attachments[0], GL_RGBA, GL_UNSIGNED_SHORT, sizeof *g->base_metallic,
          g->base_metallic },
        { t->attachments[1], GL_RG, GL_UNSIGNED_SHORT, sizeof *g->normal, g->normal },
        { t->attachments[2], GL_RG, GL_UNSIGNED_SHORT, sizeof *g->roughness_kind,
          g->roughness_kind },
        { t->attachments[3], GL_RGBA, GL_FLOAT, sizeof *g->emission, g->emission },
        { t->attachments[4], GL_RG, GL_UNSIGNED_BYTE, sizeof *g->weights, g->weights },
        { t->attachments[5], GL_RGBA, GL_UNSIGNED_SHORT, sizeof *g->coat, g->coat },
        { t->attachments[6], GL_RGBA, GL_UNSIGNED_BYTE, sizeof *g->tint, g->tint },
        { t->attachments[7], GL_RGBA, GL_UNSIGNED_BYTE, sizeof *g->sheen, g->sheen },
    };
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    for (size_t i = 0; i < sizeof planes / sizeof *planes && planes[i].to; i++) {
        if (count * planes[i].size > INT32_MAX)
            return base_fail(error, NULL, "an image of %d x %d is too large to read back", t->width,
                             t->height);
        glGetTextureImage(planes[i].texture, 0, planes[i].format, planes[i].type,
                          (GLsizei)(count * planes[i].size), planes[i].to);
    }
    return true;
}

/* --- decoding --------------------------------------------------------------------------------- */

/* Computes the positions of a row's pixels as camera.glsl does; those of pixels without a surface
 * are meaningless. */
static void decode_positions(const gpu_gbuffer *g, int y, float reach) {
    const render_surfaces *s = &g->surfaces;
    const render_camera *c = &s->camera;
    const size_t first = (size_t)y * (size_t)g->width;
    const float v = (float)y * c->step[1] + c->first[1];
    const float across = c->step[0], start = c->first[0];
    float from[3], left[3], aside[3], right[3];
    for (int i = 0; i < 3; i++) {
        from[i] = c->eye[i] + (c->parallel ? c->down[i] * v : 0);
        left[i] = c->forward[i] + (c->parallel ? 0 : c->down[i] * v);
        aside[i] = c->parallel ? c->right[i] : 0;
        right[i] = c->parallel ? 0 : c->right[i];
    }
    const float *restrict depth = g->depth + first;
    float *restrict px = s->position[0] + first, *restrict py = s->position[1] + first;
    float *restrict pz = s->position[2] + first;
    const bool parallel = c->parallel;
    const int count = g->width;
#pragma omp simd
    for (int x = 0; x < count; x++) {
        const float u = (float)x * across + start;
        const float distance = parallel ? 2 * reach * (1 - depth[x]) : reach / depth[x];
        px[x] = from[0] + aside[0] * u + (left[0] + right[0] * u) * distance;
        py[x] = from[1] + aside[1] * u + (left[1] + right[1] * u) * distance;
        pz[x] = from[2] + aside[2] * u + (left[2] + right[2] * u) * distance;
    }
}

/* Decodes an octahedral normal: where z < 0 the triangles are folded outwards. */
static inline void decode_normal(uint16_t u, uint16_t v, size_t i, float *const n[3]) {
    const float p = (float)u * (2 / 65535.0f) - 1, q = (float)v * (2 / 65535.0f) - 1;
    const float z = 1 - fabsf(p) - fabsf(q), fold = (fabsf(z) - z) * 0.5f;
    const float w = p - copysignf(fold, p), h = q - copysignf(fold, q);
    const float scale = 1 / sqrtf(w * w + h * h + z * z);
    n[0][i] = w * scale;
    n[1][i] = h * scale;
    n[2][i] = z * scale;
}

static float unit(uint16_t stored) {
    return (float)stored / 65535;
}

static float square(float root) {
    return root * root;
}

/* Decodes three bytes, each the square root of a channel. */
static void decode_color(const uint8_t *root, size_t i, float *const color[3]) {
    for (int c = 0; c < 3; c++)
        color[c][i] = (float)(root[c] * root[c]) / 65025;
}

static void decode_layers(const gpu_gbuffer *g, size_t i) {
    const render_surfaces *s = &g->surfaces;
    decode_normal(g->coat[i].u, g->coat[i].v, i, s->coat_normal);
    s->coat[i] = unit(g->coat[i].weight);
    s->coat_roughness[i] = unit(g->coat[i].roughness);
    decode_color(g->tint[i], i, s->tint);
    decode_color(g->sheen[i], i, s->sheen);
    s->sheen_roughness[i] = (float)g->sheen[i][3] / 255;
}

/* Decodes the transmitted color, which gbuffer_pack_color has packed. */
static void decode_transmitted(const gpu_gbuffer *g, size_t i) {
    const render_surfaces *s = &g->surfaces;
    const uint32_t packed = (uint32_t)g->emission[i][3];
    const uint8_t root[3] = { (uint8_t)packed, (uint8_t)(packed >> 8), (uint8_t)(packed >> 16) };
    decode_color(root, i, s->transmitted);
}

static uint32_t decode_kind(const gpu_gbuffer *g, size_t i) {
    const unsigned kind = g->roughness_kind[i].v;
    return kind == SHARED_KIND_NONE    ? RENDER_SEES_NOTHING
           : kind == SHARED_KIND_LIGHT ? RENDER_SEES_LIGHT + g->normal[i].u
                                       : kind - SHARED_KIND_SURFACE;
}

static void decode_row(const gpu_gbuffer *g, int y, float reach) {
    const render_surfaces *s = &g->surfaces;
    const size_t first = (size_t)y * (size_t)g->width, end = first + (size_t)g->width;
    decode_positions(g, y, reach);
#pragma omp simd
    for (size_t i = first; i < end; i++)
        decode_normal(g->normal[i].u, g->normal[i].v, i, s->normal);
    for (size_t i = first; i < end; i++) {
        for (int c = 0; c < 3; c++) {
            s->base[c][i] = square(unit(g->base_metallic[i].root[c]));
            s->emission[c][i] = g->emission[i][c];
        }
        s->metallic[i] = unit(g->base_metallic[i].metallic);
        s->roughness[i] = unit(g->roughness_kind[i].u);
        s->ambient[i] = (float)g->weights[i].u / 255;
        s->specular[i] = (float)g->weights[i].v / 255;
        s->seen[i] = decode_kind(g, i);
        if (g->coat)
            decode_layers(g, i);
        if (s->translucent)
            decode_transmitted(g, i);
    }
}

bool gpu_gbuffer_read(const gpu_targets *t, const render_materials *materials,
                      const environment *around, const render_camera *camera, float reach,
                      const render_frame *frame, gpu_gbuffer *g, base_error *error) {
    if ((g->width != t->width || g->height != t->height) &&
        !allocate(g, t->width, t->height, materials, error))
        return false;
    if (!read_attachments(t, g, error))
        return false;
    g->surfaces.camera = *camera;
    g->surfaces.frame = frame;
    g->surfaces.materials = materials;
    g->surfaces.environment = around;
#pragma omp parallel for schedule(dynamic, 8)
    for (int y = 0; y < g->height; y++)
        decode_row(g, y, reach);
    return true;
}
