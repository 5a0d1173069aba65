/* SPDX-License-Identifier: MIT */
/* accumulate.h - many RGB lights into each of many points: lanes are points, lights are broadcast.
 *
 * The sums lie in memory by columns m, a tile of them at a time: as many as the stack has room for,
 * of which no function of the library may need more than 64 KB, or what the caller lends. Lights go
 * two at a time, so that a sum is loaded and stored once for both and neither waits for its own
 * recurrences; each is still added on its own, in order. Where a tile leaves the first lights is
 * kept for the next one; the others begin anew. */
#ifndef LAMPION_KERNELS_ACCUMULATE_H
#define LAMPION_KERNELS_ACCUMULATE_H

#include "src/kernels/accumulate_tile.h"
#include "src/kernels/cap.h"

/* Registers of a call's stack, 55 KiB: lights kept, bands of the lights of a pass, sums. Code that
 * is to be debugged keeps more there; no result depends on it. */
#ifdef NDEBUG
#define ACCUMULATE_FLOATS 14080
#else
#define ACCUMULATE_FLOATS 13568
#endif
#define ACCUMULATE_STACK (LMP_LANES > 4 ? ACCUMULATE_FLOATS / LMP_LANES : 3520)

/* Lights a pass. */
#define ACCUMULATE_LIGHTS 2

static inline float lights_at(const float *array, size_t stride, size_t i) {
    float value;
    memcpy(&value, (const char *)array + i * stride, sizeof value);
    return value;
}

static inline lmp_rgb lights_radiance(const lmp_kernel_lights *lights, size_t i) {
    const lmp_vec3_array *radiance = &lights->radiance;
    const lmp_rgb rgb = { lights_at(radiance->x, radiance->stride, i),
                          lights_at(radiance->y, radiance->stride, i),
                          lights_at(radiance->z, radiance->stride, i) };
    return rgb;
}

LMP_INLINE cap_lanes lights_cap(const lmp_kernel_lights *lights, size_t i, const vf point[3],
                                int gradient) {
    const lmp_vec3_array *center = &lights->center;
    return cap_from(lights_at(center->x, center->stride, i) - point[0],
                    lights_at(center->y, center->stride, i) - point[1],
                    lights_at(center->z, center->stride, i) - point[2],
                    vf_set(lights_at(lights->radius.at, lights->radius.stride, i)), gradient);
}

/* Of what a light is at the points from `element` on, what comes. */
LMP_INLINE void lights_hide(const lmp_kernel_lights *lights, size_t i, size_t element, size_t live,
                            cap_lanes *cap) {
    const float *plane = lights->visibility + i * lights->visibility_stride + element;
    const vf visible = live == LMP_LANES ? vf_load(plane) : vf_load_first(plane, (int)live);
    cap->s2 = cap->s2 * visible;
    cap->t_full = cap->t_full * visible;
}

/* Where a light stands: at column m R_m, as cap_radial has it (R_1 where m is 0), C_m and S_m. */
typedef struct accumulate_light {
    vf x, y, z, t;
    vf radial, difference;
    vf c, s;
} accumulate_light;

/* The lights of a call, and how its memory is divided. */
typedef struct accumulate_work {
    int bands, most; /* pairs of a tile */
    const lmp_kernel_lights *lights;
    size_t element, live; /* the points */
    size_t kept_count;
    accumulate_light *kept;
    vf *waiting, *sums;
} accumulate_work;

LMP_INLINE void accumulate_radial_step(int l, accumulate_light *light) {
    light->difference =
        lmp_table_cap_d[l] * light->difference - lmp_table_cap_t[l] * light->t * light->radial;
    light->radial = light->radial + light->difference;
}

LMP_INLINE void accumulate_rotate(int m, accumulate_light *light) {
    basis_rotate(m, light->x, light->y, &light->c, &light->s);
}

/* At column 0; returns the factor of band 0. Inside, R_l changes sign with even l but 0:
 * so do the coefficients of a light of negative radiance on the other side. */
LMP_INLINE vf accumulate_begin(cap_lanes cap, accumulate_light *light) {
    const vf pi = vf_set(LMP_KERNEL_PI);
    cap_axis(&cap);
    *light = (accumulate_light) { cap.x,       cap.y,     cap.z,     cap.t,
                                  pi * cap.s2, vf_set(0), vf_set(1), vf_set(0) };
    if (__builtin_expect(cap.inside, 0)) {
        light->x = light->x * cap.even;
        light->y = light->y * cap.even;
        light->z = light->z * cap.even;
        light->radial = light->radial * cap.even;
    }
    return (pi + pi) * cap.t_full;
}

/* From column 0 to column m. */
LMP_INLINE void accumulate_advance(int m, int at_once, accumulate_light *light) {
    LMP_ROLLED for (int i = 1; i <= m; i++) LMP_UNROLL for (int k = 0; k < at_once; k++) {
        accumulate_rotate(i, &light[k]);
        if (i > 1)
            accumulate_radial_step(i, &light[k]);
    }
}

/* R_l of a tile's bands, light k's at waiting[at_once * (l - low) + k]; but that of band 0 is there
 * from the start. Where columns end, the lights go on to the column after the tile. */
LMP_INLINE void accumulate_radial(int bands, accumulate_tile tile, int at_once,
                                  accumulate_light *light, vf *waiting) {
    accumulate_light now[ACCUMULATE_LIGHTS];
    LMP_UNROLL for (int k = 0; k < at_once; k++) now[k] = light[k];
    LMP_ROLLED for (int l = tile.first > 1 ? tile.first : 1; l < tile.high; l++) {
        LMP_UNROLL for (int k = 0; k < at_once; k++) {
            if (l > 1 && l > tile.first)
                accumulate_radial_step(l, &now[k]);
            if (l >= tile.low)
                waiting[at_once * (l - tile.low) + k] = now[k].radial;
            if (l == tile.end && tile.high == bands) {
                light[k].radial = now[k].radial;
                light[k].difference = now[k].difference;
            }
        }
    }
}

/* A light's radiance at +m, then at -m: times the cosine and the sine of m times its azimuth. */
LMP_INLINE void accumulate_colors(lmp_rgb rgb, vf c, vf s, vf color[6]) {
    color[0] = rgb.r * c;
    color[1] = rgb.g * c;
    color[2] = rgb.b * c;
    color[3] = rgb.r * s;
    color[4] = rgb.g * s;
    color[5] = rgb.b * s;
}

typedef struct accumulate_column {
    vf z[ACCUMULATE_LIGHTS], q0[ACCUMULATE_LIGHTS], q1[ACCUMULATE_LIGHTS];
} accumulate_column;

/* At its first pair, (m, m). */
LMP_INLINE void accumulate_column_begin(int m, int monic, int at_once, accumulate_column *column) {
    LMP_UNROLL for (int k = 0; k < at_once; k++) {
        column->q0[k] = vf_set(0);
        column->q1[k] = vf_set(monic ? 1 : lmp_table_diagonal[m]);
    }
}

/* To the pair of index i. Monic recurrences leave the norm N_lm to the end, and are for
 * LMP_TABLE_MONIC_BANDS (tables.h). */
LMP_INLINE void accumulate_step(size_t i, int monic, int at_once, accumulate_column *column) {
    LMP_UNROLL for (int k = 0; k < at_once; k++) {
        const vf z = column->z[k], q0 = column->q0[k], q1 = column->q1[k];
        column->q0[k] = q1;
        column->q1[k] = monic ? z * q1 - lmp_table_monic[i] * q0
                              : lmp_table_a[i] * z * q1 + lmp_table_b[i] * q0;
    }
}

/* Adds a column of a tile to its sums: of a pair (l, m) six, red, green, blue of +m, then of -m. */
LMP_INLINE vf *accumulate_column_add(accumulate_tile tile, int m, int monic, int at_once,
                                     accumulate_column *column, vf (*color)[6], const vf *waiting,
                                     vf *sums) {
    size_t i = lmp_table_index(m, m);
    int l = m;
    accumulate_column_begin(m, monic, at_once, column);
    LMP_ROLLED for (; l < tile.low; l++) accumulate_step(++i, monic, at_once, column);
    for (const vf *radial = waiting + at_once * (l - tile.low);; radial += at_once) {
        vf value[ACCUMULATE_LIGHTS];
        LMP_UNROLL for (int k = 0; k < at_once; k++) value[k] = column->q1[k] * radial[k];
        LMP_UNROLL for (int j = 0; j < 6; j++) {
            if (m == 0 && j == 3)
                break;
            vf sum = sums[j];
            LMP_UNROLL for (int k = 0; k < at_once; k++) sum = sum + color[k][j] * value[k];
            sums[j] = sum;
        }
        sums += 6;
        if (++l == tile.high)
            return sums;
        accumulate_step(++i, monic, at_once, column);
    }
}

/* Adds `at_once` lights to the sums of a tile; pairs follow one another by m, then l. */
LMP_INLINE void accumulate_lights(const accumulate_work *work, accumulate_tile tile, int monic,
                                  int keeps, int at_once, size_t first, const vf point[3]) {
    accumulate_light *kept = keeps && first < work->kept_count ? work->kept + first : NULL;
    accumulate_light light[ACCUMULATE_LIGHTS];
    accumulate_column column;
    lmp_rgb rgb[ACCUMULATE_LIGHTS];
    vf *sums = work->sums, color[ACCUMULATE_LIGHTS][6];
    if (kept && (tile.first > 0 || tile.low > 0)) {
        LMP_UNROLL for (int k = 0; k < at_once; k++) light[k] = kept[k];
    } else {
        LMP_UNROLL for (int k = 0; k < at_once; k++) {
            cap_lanes cap = lights_cap(work->lights, first + (size_t)k, point, 0);
            if (__builtin_expect(work->lights->visibility != NULL, 0))
                lights_hide(work->lights, first + (size_t)k, work->element, work->live, &cap);
            work->waiting[k] = accumulate_begin(cap, &light[k]);
        }
        accumulate_advance(tile.first, at_once, light);
    }
    accumulate_radial(work->bands, tile, at_once, light, work->waiting);
    LMP_UNROLL for (int k = 0; k < at_once; k++) {
        rgb[k] = lights_radiance(work->lights, first + (size_t)k);
        column.z[k] = light[k].z;
    }
    for (int m = tile.first; m < tile.end; m++) {
        LMP_UNROLL for (int k = 0; k < at_once; k++) {
            if (m > tile.first)
                accumulate_rotate(m, &light[k]);
            accumulate_colors(rgb[k], light[k].c, light[k].s, color[k]);
        }
        sums = accumulate_column_add(tile, m, monic, at_once, &column, color, work->waiting, sums);
    }
    if (!kept)
        return;
    LMP_UNROLL for (int k = 0; k < at_once; k++) {
        if (tile.high == work->bands)
            accumulate_rotate(tile.end, &light[k]);
        kept[k] = light[k];
    }
}

/* Registers that wait of the `left`, `each` a band, where sums take `width` a pair: for all bands,
 * or for as many as a tile has, which are no more than its pairs. */
static inline int accumulate_waits(int bands, int left, int each, int width) {
    const int most = left / (each + width) + 1;
    const int waiting = each * (bands < most ? bands : most);
    return waiting < ACCUMULATE_WAITING ? ACCUMULATE_WAITING : waiting;
}

/* Registers of memory: the stack's, or of what is lent, if that is more, the first LMP_SCRATCH_SIZE
 * bytes. */
typedef struct accumulate_memory {
    vf *at;
    int count;
} accumulate_memory;

static inline accumulate_memory accumulate_lent(const lmp_scratch *scratch, vf *stack) {
    const size_t size = scratch ? scratch->size : 0;
    const size_t lent = (size < LMP_SCRATCH_SIZE ? size : LMP_SCRATCH_SIZE) / sizeof *stack;
    if (lent <= ACCUMULATE_STACK)
        return (accumulate_memory) { stack, ACCUMULATE_STACK };
    return (accumulate_memory) { scratch->memory, (int)lent };
}

/* Lights are kept where there are tiles for them, in a third of the memory at most. */
static inline void accumulate_divide(accumulate_work *work, accumulate_memory memory) {
    const int bands = work->bands;
    int left = memory.count;
    if (3 * bands * (bands + 1) > left - ACCUMULATE_WAITING) {
        const size_t each = sizeof *work->kept / sizeof *memory.at, count = work->lights->count;
        const size_t passes = (size_t)memory.count / 3 / each / ACCUMULATE_LIGHTS;
        const size_t most = passes * ACCUMULATE_LIGHTS;
        work->kept = (accumulate_light *)(void *)memory.at;
        work->kept_count = count < most ? count : most;
        left -= (int)(work->kept_count * each);
    }
    const int waiting = accumulate_waits(bands, left, ACCUMULATE_LIGHTS, 6);
    work->waiting = memory.at + memory.count - left;
    work->sums = work->waiting + waiting;
    work->most = (left - waiting) / 6;
}

/* Lights are not kept where one tile holds all: what it would take to go on is compiled away. */
LMP_INLINE void accumulate_all_lights(const accumulate_work *work, accumulate_tile tile, int monic,
                                      int keeps, const vf point[3]) {
    size_t i = 0;
    for (; i + ACCUMULATE_LIGHTS <= work->lights->count; i += ACCUMULATE_LIGHTS)
        accumulate_lights(work, tile, monic, keeps, ACCUMULATE_LIGHTS, i, point);
    for (; i < work->lights->count; i++)
        accumulate_lights(work, tile, monic, keeps, 1, i, point);
}

/* The sums are of red, green, blue. */
static inline accumulate_sets accumulate_colors_of(const accumulate_work *work) {
    return (accumulate_sets) { 3, 0, 3, work->lights->adds };
}

/* One tile of all. Functions of their own, for the code of tiles would take their registers. */
static LMP_NOINLINE void accumulate_untiled(const accumulate_work *work, const vf point[3]) {
    const int bands = work->bands;
    accumulate_all_lights(work, (accumulate_tile) { 0, bands, 0, bands }, 1, 0, point);
}
static LMP_NOINLINE void accumulate_put_untiled(const accumulate_work *work,
                                                const lmp_kernel_out *out) {
    const int bands = work->bands;
    accumulate_put(bands, (accumulate_tile) { 0, bands, 0, bands }, 1, accumulate_colors_of(work),
                   work->sums, work->waiting, out, work->element, work->live);
}

LMP_INLINE void accumulate_tiles(const accumulate_work *work, int monic, const vf point[3],
                                 const lmp_kernel_out *out) {
    const int bands = work->bands;
    if (monic && bands * (bands + 1) <= 2 * work->most) {
        memset(work->sums, 0, (size_t)(3 * bands * (bands + 1)) * sizeof *work->sums);
        accumulate_untiled(work, point);
        accumulate_put_untiled(work, out);
        return;
    }
    for (accumulate_tile tile = accumulate_first(bands, work->most); tile.first < bands;
         tile = accumulate_next(bands, tile, work->most)) {
        memset(work->sums, 0, 6 * accumulate_pairs(tile) * sizeof *work->sums);
        accumulate_all_lights(work, tile, monic, 1, point);
        accumulate_put(bands, tile, monic, accumulate_colors_of(work), work->sums, work->waiting,
                       out, work->element, work->live);
    }
}

/* The sums of the lights at the points from `element` on, a block of them. */
static LMP_NOINLINE void accumulate_block(const lmp_scratch *scratch, int bands,
                                          const lmp_kernel_lights *lights,
                                          const lmp_kernel_vec3 *points, const lmp_kernel_out *out,
                                          size_t element, size_t live) {
    const vf point[3] = { vf_load(points->x + element), vf_load(points->y + element),
                          vf_load(points->z + element) };
    vf stack[ACCUMULATE_STACK];
    accumulate_work work = { .bands = bands, .lights = lights, .element = element, .live = live };
    accumulate_divide(&work, accumulate_lent(scratch, stack));
    if (bands <= LMP_TABLE_MONIC_BANDS)
        accumulate_tiles(&work, 1, point, out);
    else
        accumulate_tiles(&work, 0, point, out);
}

#endif
