/* SPDX-License-Identifier: MIT */
#include "app/render/cpu/levels.h"

#include "app/base/memory.h"
#include "app/image/srgb.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CURVE = CPU_CURVE };

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

/* Returns the byte that encodes a value best. */
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

/* The texels of a level of size `from` that texel i of the next level, of size `to`, covers, and
 * their weights. */
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
    /* of an odd number, each texel covers from / to texels: two and a fraction, spread over
     * three */
    c.count = 3;
    c.weights[0] = (float)(to - i) / (float)from;
    c.weights[1] = (float)to / (float)from;
    c.weights[2] = (float)(i + 1) / (float)from;
    return c;
}

static void halve(const cpu_textures *t, bool srgb, const cpu_level *from, const cpu_level *to,
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

/* Sets the sizes of the levels; returns the bytes of all but the first. */
static size_t measure_levels(cpu_texture *to) {
    size_t bytes = 0;
    uint32_t width = to->levels[0].width, height = to->levels[0].height;
    for (to->count = 1; width > 1 || height > 1; to->count++) {
        width = half_of(width);
        height = half_of(height);
        to->levels[to->count] = (cpu_level) { width, height, NULL };
        bytes += 4 * (size_t)width * height;
    }
    return bytes;
}

static void make_levels(const cpu_textures *t, cpu_texture *to, unsigned char *memory) {
    for (int i = 1; i < to->count; i++) {
        to->levels[i].texels = memory;
        halve(t, to->srgb, &to->levels[i - 1], &to->levels[i], memory);
        memory += 4 * (size_t)to->levels[i].width * to->levels[i].height;
    }
}

/* Returns an earlier texture with the same texels and color space, or NULL. */
static const cpu_texture *find_same(const cpu_textures *t, size_t number) {
    const cpu_texture *to = &t->of[number];
    for (size_t i = 0; i < number; i++)
        if (t->of[i].levels[0].texels == to->levels[0].texels && t->of[i].srgb == to->srgb &&
            t->of[i].levels[0].width == to->levels[0].width &&
            t->of[i].levels[0].height == to->levels[0].height)
            return &t->of[i];
    return NULL;
}

/* Makes the levels of every texture; textures with the same levels share them. */
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
                const cpu_texture *same = find_same(t, i);
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
        t->of[i] = (cpu_texture) { .srgb = from->srgb,
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
