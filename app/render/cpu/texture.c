/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/texture.h"

#include "app/image/srgb.h"
#include "app/memory/memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEVELS = 32, TAPS_MAX = 8, CURVE = 4096 };

typedef struct level {
    uint32_t width, height;
    const unsigned char *texels; /* RGBA */
} level;

typedef struct texture {
    level levels[LEVELS];
    int count; /* 0 until they are measured */
    bool srgb;
    uint32_t wrap_u, wrap_v;
} texture;

struct cpu_textures {
    texture *of;
    size_t count;
    unsigned char *memory;       /* of the levels below the first */
    float linear[2][256];        /* what a byte means: by itself, and of sRGB */
    unsigned char encode[CURVE]; /* a byte of sRGB at most, from the root of a linear value */
};

/* --- the curve of sRGB ------------------------------------------------------------------------ */

static void make_curve(cpu_textures *t) {
    for (int i = 0; i < 256; i++) {
        t->linear[0][i] = (float)i / 255;
        t->linear[1][i] = (float)image_srgb_to_linear(i / 255.0);
    }
    for (int i = 0, byte = 0; i < CURVE; i++) {
        const float root = ((float)i + 1) / CURVE;
        while (byte < 255 && 0.5f * (t->linear[1][byte] + t->linear[1][byte + 1]) <= root * root)
            byte++;
        t->encode[i] = (unsigned char)byte;
    }
}

/* The byte whose value is nearest. */
static unsigned char encode(const cpu_textures *t, bool srgb, float linear) {
    if (!srgb)
        return (unsigned char)(linear * 255 + 0.5f);
    const int cell = (int)(sqrtf(linear) * CURVE);
    int byte = t->encode[cell < CURVE ? cell : CURVE - 1];
    const float *value = t->linear[1];
    while (byte > 0 && linear < 0.5f * (value[byte] + value[byte - 1]))
        byte--;
    return (unsigned char)byte;
}

/* --- levels ----------------------------------------------------------------------------------- */

/* Of `from` texels those that texel i of `to` covers, and how much of each. */
typedef struct cover {
    uint32_t first;
    int count;
    float weights[3];
} cover;

static cover cover_of(uint32_t i, uint32_t from, uint32_t to) {
    cover c = { .first = i * 2 };
    if (from == to)
        return (cover) { i, 1, { 1 } };
    if (from % 2 == 0) {
        c.count = 2;
        c.weights[0] = c.weights[1] = 0.5f;
        return c;
    }
    /* each of an odd number is covered by two and a fraction of their number's inverse */
    c.count = 3;
    c.weights[0] = (float)(to - i) / (float)from;
    c.weights[1] = (float)to / (float)from;
    c.weights[2] = (float)(i + 1) / (float)from;
    return c;
}

static void halve(const cpu_textures *t, bool srgb, const level *from, const level *to,
                  unsigned char *texels) {
    for (uint32_t y = 0; y < to->height; y++) {
        const cover rows = cover_of(y, from->height, to->height);
        for (uint32_t x = 0; x < to->width; x++) {
            const cover columns = cover_of(x, from->width, to->width);
            float sum[4] = { 0 };
            for (int j = 0; j < rows.count; j++)
                for (int i = 0; i < columns.count; i++) {
                    const size_t at = (size_t)(rows.first + (uint32_t)j) * from->width +
                                      columns.first + (uint32_t)i;
                    const float weight = rows.weights[j] * columns.weights[i];
                    for (size_t c = 0; c < 4; c++)
                        sum[c] += weight * t->linear[srgb && c < 3][from->texels[4 * at + c]];
                }
            for (size_t c = 0; c < 4; c++)
                texels[4 * ((size_t)y * to->width + x) + c] = encode(t, srgb && c < 3, sum[c]);
        }
    }
}

static uint32_t half_of(uint32_t side) {
    return side > 1 ? side / 2 : 1;
}

/* Sets the sizes of the levels; returns the bytes of those below the first. */
static size_t measure_levels(texture *to) {
    size_t bytes = 0;
    uint32_t width = to->levels[0].width, height = to->levels[0].height;
    for (to->count = 1; width > 1 || height > 1; to->count++) {
        width = half_of(width);
        height = half_of(height);
        to->levels[to->count] = (level) { width, height, NULL };
        bytes += 4 * (size_t)width * height;
    }
    return bytes;
}

static void make_levels(const cpu_textures *t, texture *to, unsigned char *memory) {
    for (int i = 1; i < to->count; i++) {
        to->levels[i].texels = memory;
        halve(t, to->srgb, &to->levels[i - 1], &to->levels[i], memory);
        memory += 4 * (size_t)to->levels[i].width * to->levels[i].height;
    }
}

/* The one before it that shows the same texels by the same curve, or none. */
static const texture *find_same(const cpu_textures *t, size_t number) {
    const texture *to = &t->of[number];
    for (size_t i = 0; i < number; i++)
        if (t->of[i].levels[0].texels == to->levels[0].texels && t->of[i].srgb == to->srgb &&
            t->of[i].levels[0].width == to->levels[0].width &&
            t->of[i].levels[0].height == to->levels[0].height)
            return &t->of[i];
    return NULL;
}

/* Every texture's levels; those that are the same are there once. */
static bool make_all_levels(cpu_textures *t) {
    size_t *first = malloc((t->count + 1) * sizeof *first), bytes = 0;
    for (size_t i = 0; first && i < t->count; i++) {
        first[i] = bytes;
        bytes += find_same(t, i) ? 0 : measure_levels(&t->of[i]);
    }
    t->memory = first ? memory_large(bytes) : NULL;
    if (t->memory) {
#pragma omp parallel for schedule(dynamic)
        for (size_t i = 0; i < t->count; i++)
            if (t->of[i].count > 0)
                make_levels(t, &t->of[i], t->memory + first[i]);
        for (size_t i = 0; i < t->count; i++)
            if (t->of[i].count == 0) {
                const texture *same = find_same(t, i);
                memcpy(t->of[i].levels, same->levels, sizeof same->levels);
                t->of[i].count = same->count;
            }
    }
    free(first);
    return t->memory;
}

cpu_textures *cpu_textures_create(const scene *world) {
    cpu_textures *t = calloc(1, sizeof *t);
    if (t)
        t->of = calloc(world->texture_count + 1, sizeof *t->of);
    if (!t || !t->of) {
        cpu_textures_destroy(t);
        return NULL;
    }
    make_curve(t);
    t->count = world->texture_count;
    for (size_t i = 0; i < t->count; i++) {
        const scene_texture *from = &world->textures[i];
        t->of[i] = (texture) { .srgb = from->srgb,
                               .wrap_u = from->wrap_u,
                               .wrap_v = from->wrap_v,
                               .levels[0] = { from->width, from->height,
                                              world->texels + from->first_byte } };
    }
    if (make_all_levels(t))
        return t;
    cpu_textures_destroy(t);
    return NULL;
}

void cpu_textures_destroy(cpu_textures *t) {
    if (!t)
        return;
    free(t->memory);
    free(t->of);
    free(t);
}

/* --- look-ups --------------------------------------------------------------------------------- */

/* A coordinate within 0 … 1 that shows the same. */
static float fold(float u, uint32_t mode) {
    if (u >= 0 && u <= 1)
        return u;
    if (mode == SCENE_WRAP_CLAMP)
        return u > 0 ? 1 : 0;
    const float turns = mode == SCENE_WRAP_REPEAT ? u : 0.5f * u;
    const float part = turns - floorf(turns); /* of what is not finite NaN */
    if (!(part >= 0 && part <= 1))
        return 0;
    return mode == SCENE_WRAP_REPEAT ? part : 2 * (part < 0.5f ? part : 1 - part);
}

/* The two texels around a coordinate within 0 … 1, and how much of the second is there. Past an
 * edge lies the other one of a texture that repeats, and else the edge itself. */
typedef struct neighbors {
    uint32_t texels[2];
    float part;
} neighbors;

static inline neighbors find_neighbors(float u, uint32_t size, uint32_t mode) {
    const float x = u * (float)size + 0.5f; /* of the second one's left edge */
    const uint32_t second = (uint32_t)x, last = size - 1;
    const bool repeats = mode == SCENE_WRAP_REPEAT;
    neighbors n = { { second - 1, second }, x - (float)second };
    if (second == 0)
        n.texels[0] = repeats ? last : 0;
    if (second > last)
        n.texels[1] = repeats ? 0 : last;
    return n;
}

static void add_bilinear(const cpu_textures *t, const texture *from, int number, float u, float v,
                         float weight, float rgba[4]) {
    const level *l = &from->levels[number];
    const neighbors x = find_neighbors(u, l->width, from->wrap_u);
    const neighbors y = find_neighbors(v, l->height, from->wrap_v);
    const float *const color = t->linear[from->srgb], *const alpha = t->linear[0];
    const float columns[2] = { 1 - x.part, x.part };
    const float rows[2] = { weight * (1 - y.part), weight * y.part };
    float sum[4] = { rgba[0], rgba[1], rgba[2], rgba[3] };
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++) {
            const unsigned char *texel =
                l->texels + 4 * ((size_t)y.texels[j] * l->width + x.texels[i]);
            const float w = rows[j] * columns[i];
            sum[0] += w * color[texel[0]];
            sum[1] += w * color[texel[1]];
            sum[2] += w * color[texel[2]];
            sum[3] += w * alpha[texel[3]];
        }
    memcpy(rgba, sum, sizeof sum);
}

/* The logarithm to base 2 of x > 0 within 0.01, by arithmetic whose bits are the same everywhere.
 */
static float log2_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int exponent = (int)(bits >> 23) - 127;
    bits = (bits & 0x7fffff) | 0x3f800000;
    memcpy(&x, &bits, sizeof x);
    return (float)exponent + (x - 1) * (1.3465553f - 0.3465553f * (x - 1));
}

/* Both levels of detail around `lod`. */
static void add_trilinear(const cpu_textures *t, const texture *from, float lod, float at_u,
                          float at_v, float weight, float rgba[4]) {
    const float u = fold(at_u, from->wrap_u), v = fold(at_v, from->wrap_v);
    const float last = (float)(from->count - 1);
    const float held = lod > 0 ? fminf(lod, last) : 0;
    const int finer = (int)held;
    const float part = held - (float)finer;
    add_bilinear(t, from, finer, u, v, weight * (1 - part), rgba);
    if (part > 0)
        add_bilinear(t, from, finer + 1, u, v, weight * part, rgba);
}

/* A footprint's sides in the coordinates that the texture is read by. */
typedef struct mapped {
    float at[2], across[2], down[2];
} mapped;

static mapped map_footprint(const scene_texture_use *use, const cpu_footprint *f) {
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

static float texels_along(const texture *t, const float side[2]) {
    const float x = side[0] * (float)t->levels[0].width, y = side[1] * (float)t->levels[0].height;
    return sqrtf(x * x + y * y);
}

/* After EXT_texture_filter_anisotropic: several samples along the longer side, of a level that
 * suits what lies between them. */
void cpu_texture_at(const cpu_textures *textures, const scene_texture_use *use,
                    const cpu_footprint *footprint, float rgba[4]) {
    const texture *t = &textures->of[use->texture];
    const mapped m = map_footprint(use, footprint);
    const float across = texels_along(t, m.across), down = texels_along(t, m.down);
    const float longer = fmaxf(across, down), shorter = fminf(across, down);
    const float *side = across > down ? m.across : m.down;
    memset(rgba, 0, 4 * sizeof *rgba);
    int taps = 1;
    while (taps < TAPS_MAX && longer > 1 && longer > shorter * (float)taps && longer > (float)taps)
        taps++;
    const float lod = longer > (float)taps ? log2_of(longer / (float)taps) : 0;
    for (int i = 0; i < taps; i++) {
        const float along = ((float)i + 0.5f) / (float)taps - 0.5f;
        add_trilinear(textures, t, lod, m.at[0] + side[0] * along, m.at[1] + side[1] * along,
                      1 / (float)taps, rgba);
    }
}
