/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/texture.h"

#include "app/scene/trace/wide.h"

#include <math.h>
#include <string.h>

/* --- points of a texture ---------------------------------------------------------------------- */

/* Wraps coordinates into 0 … 1; those that are not finite become 0. */
static inline void fold(float *u, int count, uint32_t mode) {
    if (mode == SCENE_WRAP_CLAMP)
        for (int i = 0; i < count; i++)
            u[i] = u[i] > 0 ? (u[i] < 1 ? u[i] : 1) : 0;
    else if (mode == SCENE_WRAP_REPEAT)
        for (int i = 0; i < count; i++) {
            const float part = u[i] - floorf(u[i]);
            u[i] = part >= 0 && part <= 1 ? part : 0;
        }
    else
        for (int i = 0; i < count; i++) {
            const float part = 0.5f * u[i] - floorf(0.5f * u[i]);
            u[i] = part >= 0 && part <= 1 ? 2 * (part < 0.5f ? part : 1 - part) : 0;
        }
}

/* The two texels around each of several coordinates in 0 … 1, and the weight of the second. Past an
 * edge lies the opposite edge of a texture that repeats, and else the edge itself. */
typedef struct neighbors {
    int32_t first[CPU_TAPS], second[CPU_TAPS];
    float part[CPU_TAPS];
} neighbors;

static inline void find_neighbors(const float *u, int count, uint32_t size, bool repeats,
                                  neighbors *n) {
    const int32_t last = (int32_t)size - 1;
    const int32_t before = repeats ? last : 0, after = repeats ? 0 : last;
    for (int i = 0; i < count; i++) {
        const float x = u[i] * (float)size + 0.5f; /* the second texel is its integer part */
        const int32_t second = (int32_t)x;
        n->part[i] = x - (float)second;
        n->first[i] = second > 0 ? second - 1 : before;
        n->second[i] = second <= last ? second : after;
    }
}

/* Adds the texels of a level, with a total weight of `weight`. */
static inline void cover_level(const cpu_texture *t, int number, const float *u, const float *v,
                               float weight, int count, uint32_t *texels, float *weights) {
    const cpu_level *l = &t->levels[number];
    neighbors x, y;
    find_neighbors(u, count, l->width, t->wrap_u == SCENE_WRAP_REPEAT, &x);
    find_neighbors(v, count, l->height, t->wrap_v == SCENE_WRAP_REPEAT, &y);
    for (int i = 0; i < count; i++) {
        const uint32_t upper = (uint32_t)y.first[i] * l->width;
        const uint32_t lower = (uint32_t)y.second[i] * l->width;
        const float low = weight * y.part[i], up = weight - low;
        texels[i] = upper + (uint32_t)x.first[i];
        texels[count + i] = upper + (uint32_t)x.second[i];
        texels[2 * count + i] = lower + (uint32_t)x.first[i];
        texels[3 * count + i] = lower + (uint32_t)x.second[i];
        weights[i] = up * (1 - x.part[i]);
        weights[count + i] = up * x.part[i];
        weights[2 * count + i] = low * (1 - x.part[i]);
        weights[3 * count + i] = low * x.part[i];
    }
}

/* --- what a footprint covers ------------------------------------------------------------------ */

/* Returns the logarithm to base 2 of x > 0 within 0.01, by arithmetic whose bits are the same
 * everywhere. */
static inline float log2_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int exponent = (int)(bits >> 23) - 127;
    bits = (bits & 0x7fffff) | 0x3f800000;
    memcpy(&x, &bits, sizeof x);
    return (float)exponent + (x - 1) * (1.3465553f - 0.3465553f * (x - 1));
}

/* A footprint's sides in the coordinates of the texture. */
typedef struct mapped {
    float at[2], across[2], down[2];
} mapped;

static inline mapped map_footprint(const scene_texture_use *use, const cpu_footprint *f) {
    const float *m = use->matrix;
    const float *uv = f->uv[use->set], *across = f->across[use->set], *down = f->down[use->set];
    mapped to;
    for (int i = 0; i < 2; i++) {
        to.at[i] = m[2 * i] * uv[0] + m[2 * i + 1] * uv[1] + use->offset[i];
        to.across[i] = m[2 * i] * across[0] + m[2 * i + 1] * across[1];
        to.down[i] = m[2 * i] * down[0] + m[2 * i + 1] * down[1];
    }
    return to;
}

static inline float texels_along(const cpu_texture *t, const float side[2]) {
    const float x = side[0] * (float)t->levels[0].width, y = side[1] * (float)t->levels[0].height;
    return sqrtf(x * x + y * y);
}

/* Returns how many points to sample along a footprint's longer side, each of which stands for a
 * square; *lod is the level of detail for such squares. */
static inline int count_taps(float longer, float shorter, float *lod) {
    const float ratio = longer / (shorter > 1 ? shorter : 1);
    int taps = 1;
    if (ratio > 1)
        taps = ratio < CPU_TAPS ? (int)ratio + ((float)(int)ratio < ratio) : CPU_TAPS;
    const float width = longer / (float)taps;
    *lod = width > 1 ? log2_of(width) : 0;
    return taps;
}

/* Covers a footprint with samples; each call site has a constant number of lanes for the
 * compiler. */
static inline void cover_lanes(const cpu_texture *t, const mapped *m, const float side[2],
                               float lod, int lanes, cpu_cover *c) {
    const float last = (float)(t->count - 1), held = lod < last ? lod : last;
    const float part = held - (float)(int)held, share = 1 / (float)c->taps;
    float u[CPU_TAPS], v[CPU_TAPS];
    for (int i = 0; i < lanes; i++) {
        const float along = ((float)i + 0.5f) * share - 0.5f;
        u[i] = m->at[0] + side[0] * along;
        v[i] = m->at[1] + side[1] * along;
    }
    fold(u, lanes, t->wrap_u);
    fold(v, lanes, t->wrap_v);
    c->lanes = lanes;
    c->finer = (int)held;
    c->levels = part > 0 ? 2 : 1;
    cover_level(t, c->finer, u, v, (1 - part) * share, lanes, c->texels[0], c->weights[0]);
    if (part > 0)
        cover_level(t, c->finer + 1, u, v, part * share, lanes, c->texels[1], c->weights[1]);
}

/* Follows EXT_texture_filter_anisotropic: several samples along the longer side, from levels that
 * suit their distance. */
TRACE_WIDE void cpu_texture_cover(const cpu_textures *textures, const scene_texture_use *use,
                                  const cpu_footprint *footprint, cpu_cover *cover) {
    const cpu_texture *t = &textures->of[use->texture];
    const mapped m = map_footprint(use, footprint);
    const float across = texels_along(t, m.across), down = texels_along(t, m.down);
    const bool wide = across > down;
    const float *side = wide ? m.across : m.down;
    float lod;
    cover->taps = count_taps(wide ? across : down, wide ? down : across, &lod);
    if (cover->taps == 1)
        cover_lanes(t, &m, side, lod, 1, cover);
    else
        cover_lanes(t, &m, side, lod, CPU_TAPS, cover);
}

bool cpu_textures_alike(const cpu_textures *textures, const scene_texture_use *a,
                        const scene_texture_use *b) {
    const cpu_texture *s = &textures->of[a->texture], *t = &textures->of[b->texture];
    return s->levels[0].width == t->levels[0].width && s->levels[0].height == t->levels[0].height &&
           s->wrap_u == t->wrap_u && s->wrap_v == t->wrap_v && a->set == b->set &&
           memcmp(a->matrix, b->matrix, sizeof a->matrix) == 0 &&
           memcmp(a->offset, b->offset, sizeof a->offset) == 0;
}

/* --- reading ---------------------------------------------------------------------------------- */

static inline void add_colors(const float linear[2][256], const unsigned char *level,
                              const uint32_t *texels, const float *weights, const cpu_cover *c,
                              float *restrict sum) {
    const float *color = linear[1], *alpha = linear[0];
    float r = 0, g = 0, b = 0, a = 0;
    for (int i = 0; i < c->taps; i++)
        for (int k = 0; k < 4; k++) {
            const unsigned char *texel = level + 4 * (size_t)texels[k * c->lanes + i];
            const float weight = weights[k * c->lanes + i];
            r += weight * color[texel[0]];
            g += weight * color[texel[1]];
            b += weight * color[texel[2]];
            a += weight * alpha[texel[3]];
        }
    sum[0] += r;
    sum[1] += g;
    sum[2] += b;
    sum[3] += a;
}

/* Adds four weighted texels in named sums, so that the compiler adds the channels as one vector. */
static inline void add_numbers(const unsigned char *level, const uint32_t *texels,
                               const float *weights, const cpu_cover *c, float *restrict sum) {
    float r = 0, g = 0, b = 0, a = 0;
    for (int i = 0; i < c->taps; i++)
        for (int k = 0; k < 4; k++) {
            const unsigned char *texel = level + 4 * (size_t)texels[k * c->lanes + i];
            const int bytes[4] = { texel[0], texel[1], texel[2], texel[3] };
            const float weight = weights[k * c->lanes + i];
            r += weight * (float)bytes[0];
            g += weight * (float)bytes[1];
            b += weight * (float)bytes[2];
            a += weight * (float)bytes[3];
        }
    sum[0] += r * (1 / 255.0f);
    sum[1] += g * (1 / 255.0f);
    sum[2] += b * (1 / 255.0f);
    sum[3] += a * (1 / 255.0f);
}

TRACE_WIDE void cpu_texture_read(const cpu_textures *textures, const scene_texture_use *use,
                                 const cpu_cover *c, float rgba[4]) {
    const cpu_texture *t = &textures->of[use->texture];
    memset(rgba, 0, 4 * sizeof *rgba);
    for (int l = 0; l < c->levels; l++) {
        const unsigned char *level = t->levels[c->finer + l].texels;
        if (t->srgb)
            add_colors(textures->linear, level, c->texels[l], c->weights[l], c, rgba);
        else
            add_numbers(level, c->texels[l], c->weights[l], c, rgba);
    }
}
