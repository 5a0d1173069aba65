/* SPDX-License-Identifier: MIT */
/* accumulate_tmpl.h - sums many RGB lights at each of many points: lanes are points, lights are
 * broadcast.
 *
 * The sums lie in memory by columns m, a tile of them at a time: as many as the stack has room for,
 * of which no function of the library may need more than 64 KB, or what the caller lends. Lights go
 * two at a time, so that a sum is loaded and stored once for both and neither waits for its own
 * recurrences; each is still added on its own, in order. The recurrences of the first lights are
 * kept from one tile to the next; the other lights start again. */
#ifndef LAMPION_KERNELS_ACCUMULATE_TMPL_H
#define LAMPION_KERNELS_ACCUMULATE_TMPL_H

#include "src/kernels/accumulate_tile_tmpl.h"
#include "src/kernels/cap_tmpl.h"
#include "src/kernels/light.h"

/* Registers on a call's stack, 54 KiB: lights kept, bands of the lights of a pass, and sums. Debug
 * builds keep more on the stack themselves; no result depends on the number. */
#ifdef NDEBUG
#define ACCUMULATE_FLOATS 13824
#else
#define ACCUMULATE_FLOATS 13568
#endif
#define ACCUMULATE_STACK (LMPI_LANES > 4 ? ACCUMULATE_FLOATS / LMPI_LANES : 3520)

/* Lights per pass. */
#define ACCUMULATE_LIGHTS 2

static inline float lights_at(const float *array, size_t stride, size_t i) {
    float value;
    memcpy(&value, (const char *)array + i * stride, sizeof value);
    return value;
}

static inline lmp_rgb lights_radiance(const lmpi_kernel_lights *lights, size_t i) {
    const lmp_vec3_array *radiance = &lights->radiance;
    const lmp_rgb rgb = { lights_at(radiance->x, radiance->stride, i),
                          lights_at(radiance->y, radiance->stride, i),
                          lights_at(radiance->z, radiance->stride, i) };
    return rgb;
}

LMPI_INLINE cap_lanes lights_cap(const lmpi_kernel_lights *lights, size_t i, const vf point[3],
                                 int gradient) {
    const lmp_vec3_array *center = &lights->center;
    return cap_from(lights_at(center->x, center->stride, i) - point[0],
                    lights_at(center->y, center->stride, i) - point[1],
                    lights_at(center->z, center->stride, i) - point[2],
                    vf_set(lights_at(lights->radius.at, lights->radius.stride, i)), gradient);
}

/* Weakens light i by its visibility at the points from `element` on. */
LMPI_INLINE void lights_hide(const lmpi_kernel_lights *lights, size_t i, size_t element,
                             size_t live, cap_lanes *cap) {
    const float *plane = lights->visibility + i * lights->visibility_stride + element;
    const vf visible = live == LMPI_LANES ? vf_load(plane) : vf_load_first(plane, (int)live);
    cap->s2 = cap->s2 * visible;
    cap->t_full = cap->t_full * visible;
}

/* The state of a light's recurrences at column m: R_m as cap_radial computes it (R_1 where m is 0),
 * C_m and S_m. */
typedef struct accumulate_light {
    vf x, y, z, t;
    vf radial, difference;
    vf c, s;
} accumulate_light;

/* The lights of a call, and how its memory is divided. */
typedef struct accumulate_work {
    int bands, most; /* pairs of a tile */
    const lmpi_kernel_lights *lights;
    size_t element, live; /* of the points */
    size_t kept_count;
    accumulate_light *kept;
    vf *waiting, *sums;
} accumulate_work;

LMPI_INLINE void accumulate_radial_step(int l, accumulate_light *light) {
    light->difference =
        lmpi_table_cap_d[l] * light->difference - lmpi_table_cap_t[l] * light->t * light->radial;
    light->radial = light->radial + light->difference;
}

LMPI_INLINE void accumulate_rotate(int m, accumulate_light *light) {
    basis_rotate(m, light->x, light->y, &light->c, &light->s);
}

/* Begins a light at column 0; returns the factor of band 0. Inside, R_l changes sign with even l
 * except 0, as do the coefficients of a light of negative radiance on the other side. */
LMPI_INLINE vf accumulate_begin(cap_lanes cap, accumulate_light *light) {
    const vf pi = vf_set(LMPI_KERNEL_PI);
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

/* Advances lights from column 0 to column m. */
LMPI_INLINE void accumulate_advance(int m, int at_once, accumulate_light *light) {
    LMPI_ROLLED for (int i = 1; i <= m; i++) LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        accumulate_rotate(i, &light[k]);
        if (i > 1)
            accumulate_radial_step(i, &light[k]);
    }
}

/* Computes R_l of a tile's bands, light k's at waiting[at_once * (l - low) + k]; that of band 0
 * must be there already. Where columns end, the lights are left at the column after the tile. */
LMPI_INLINE void accumulate_radial(int bands, accumulate_tile tile, int at_once,
                                   accumulate_light *light, vf *waiting) {
    accumulate_light now[ACCUMULATE_LIGHTS];
    LMPI_UNROLL for (int k = 0; k < at_once; k++) now[k] = light[k];
    LMPI_ROLLED for (int l = tile.first > 1 ? tile.first : 1; l < tile.high; l++) {
        LMPI_UNROLL for (int k = 0; k < at_once; k++) {
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

/* Multiplies a light's radiance by the cosine and the sine of m times its azimuth, for +m and -m.
 */
LMPI_INLINE void accumulate_colors(lmp_rgb rgb, vf c, vf s, vf color[6]) {
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

/* Begins a column at its first pair, (m, m). */
LMPI_INLINE void accumulate_column_begin(int m, int monic, int at_once, accumulate_column *column) {
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        column->q0[k] = vf_set(0);
        column->q1[k] = vf_set(monic ? 1 : lmpi_table_diagonal[m]);
    }
}

/* Advances a column to the pair of index i. Monic recurrences leave the norm N_lm to the end, and
 * are for LMPI_TABLE_MONIC_BANDS (tables.h). */
LMPI_INLINE void accumulate_step(size_t i, int monic, int at_once, accumulate_column *column) {
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        const vf z = column->z[k], q0 = column->q0[k], q1 = column->q1[k];
        column->q0[k] = q1;
        column->q1[k] = monic ? z * q1 - lmpi_table_monic[i] * q0
                              : lmpi_table_a[i] * z * q1 + lmpi_table_b[i] * q0;
    }
}

/* Adds a column of a tile to its sums: for a pair (l, m) six, red, green, blue of +m, then of -m.
 */
LMPI_INLINE vf *accumulate_column_add(accumulate_tile tile, int m, int monic, int at_once,
                                      accumulate_column *column, vf (*color)[6], const vf *waiting,
                                      vf *sums) {
    size_t i = lmpi_table_index(m, m);
    int l = m;
    accumulate_column_begin(m, monic, at_once, column);
    LMPI_ROLLED for (; l < tile.low; l++) accumulate_step(++i, monic, at_once, column);
    for (const vf *radial = waiting + at_once * (l - tile.low);; radial += at_once) {
        vf value[ACCUMULATE_LIGHTS];
        LMPI_UNROLL for (int k = 0; k < at_once; k++) value[k] = column->q1[k] * radial[k];
        LMPI_UNROLL for (int j = 0; j < 6; j++) {
            if (m == 0 && j == 3)
                break;
            vf sum = sums[j];
            LMPI_UNROLL for (int k = 0; k < at_once; k++) sum = sum + color[k][j] * value[k];
            sums[j] = sum;
        }
        sums += 6;
        if (++l == tile.high)
            return sums;
        accumulate_step(++i, monic, at_once, column);
    }
}

/* Adds `at_once` lights to the sums of a tile, whose pairs follow one another by m, then l. */
LMPI_INLINE void accumulate_lights(const accumulate_work *work, accumulate_tile tile, int monic,
                                   int keeps, int at_once, size_t first, const vf point[3]) {
    accumulate_light *kept = keeps && first < work->kept_count ? work->kept + first : NULL;
    accumulate_light light[ACCUMULATE_LIGHTS];
    accumulate_column column;
    lmp_rgb rgb[ACCUMULATE_LIGHTS];
    vf *sums = work->sums, color[ACCUMULATE_LIGHTS][6];
    if (kept && (tile.first > 0 || tile.low > 0)) {
        LMPI_UNROLL for (int k = 0; k < at_once; k++) light[k] = kept[k];
    } else {
        LMPI_UNROLL for (int k = 0; k < at_once; k++) {
            cap_lanes cap = lights_cap(work->lights, first + (size_t)k, point, 0);
            if (__builtin_expect(work->lights->visibility != NULL, 0))
                lights_hide(work->lights, first + (size_t)k, work->element, work->live, &cap);
            work->waiting[k] = accumulate_begin(cap, &light[k]);
        }
        accumulate_advance(tile.first, at_once, light);
    }
    accumulate_radial(work->bands, tile, at_once, light, work->waiting);
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        rgb[k] = lights_radiance(work->lights, first + (size_t)k);
        column.z[k] = light[k].z;
    }
    for (int m = tile.first; m < tile.end; m++) {
        LMPI_UNROLL for (int k = 0; k < at_once; k++) {
            if (m > tile.first)
                accumulate_rotate(m, &light[k]);
            accumulate_colors(rgb[k], light[k].c, light[k].s, color[k]);
        }
        sums = accumulate_column_add(tile, m, monic, at_once, &column, color, work->waiting, sums);
    }
    if (!kept)
        return;
    LMPI_UNROLL for (int k = 0; k < at_once; k++) {
        if (tile.high == work->bands)
            accumulate_rotate(tile.end, &light[k]);
        kept[k] = light[k];
    }
}

/* Returns how many of the `left` registers hold values of bands, `each` per band, where sums take
 * `width` per pair: those of all bands, or of as many as a tile can have, which are no more than
 * its pairs. */
static inline int accumulate_waits(int bands, int left, int each, int width) {
    const int most = left / (each + width) + 1;
    const int waiting = each * (bands < most ? bands : most);
    return waiting < ACCUMULATE_WAITING ? ACCUMULATE_WAITING : waiting;
}

/* Registers of memory: those on the stack or, if they are more, those in the first LMP_SCRATCH_SIZE
 * bytes of what is lent. */
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

/* Divides the memory. Lights are kept only where there are several tiles, in at most a third of it.
 */
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

/* Adds all lights to a tile. Where one tile holds all, lights are not kept, and the code for that
 * is compiled away. */
LMPI_INLINE void accumulate_all_lights(const accumulate_work *work, accumulate_tile tile, int monic,
                                       int keeps, const vf point[3]) {
    size_t i = 0;
    for (; i + ACCUMULATE_LIGHTS <= work->lights->count; i += ACCUMULATE_LIGHTS)
        accumulate_lights(work, tile, monic, keeps, ACCUMULATE_LIGHTS, i, point);
    for (; i < work->lights->count; i++)
        accumulate_lights(work, tile, monic, keeps, 1, i, point);
}

/* Returns the sets of sums of red, green and blue. */
static inline accumulate_sets accumulate_colors_of(const accumulate_work *work) {
    return (accumulate_sets) { 3, 0, 3, work->lights->adds };
}

/* Add lights to one tile of all sums, and write it. They are functions of their own, because the
 * code of tiles would take their registers. */
static LMPI_NOINLINE void accumulate_untiled(const accumulate_work *work, const vf point[3]) {
    const int bands = work->bands;
    accumulate_all_lights(work, (accumulate_tile) { 0, bands, 0, bands }, 1, 0, point);
}
static LMPI_NOINLINE void accumulate_put_untiled(const accumulate_work *work,
                                                 const lmpi_kernel_out *out) {
    const int bands = work->bands;
    accumulate_put(bands, (accumulate_tile) { 0, bands, 0, bands }, 1, accumulate_colors_of(work),
                   work->sums, work->waiting, out, work->element, work->live);
}

LMPI_INLINE void accumulate_tiles(const accumulate_work *work, int monic, const vf point[3],
                                  const lmpi_kernel_out *out) {
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

/* Sums the lights at a block of points from `element` on. */
static LMPI_NOINLINE void accumulate_block(const lmp_scratch *scratch, int bands,
                                           const lmpi_kernel_lights *lights,
                                           const lmpi_kernel_vec3 *points,
                                           const lmpi_kernel_out *out, size_t element,
                                           size_t live) {
    const vf point[3] = { vf_load(points->x + element), vf_load(points->y + element),
                          vf_load(points->z + element) };
    vf stack[ACCUMULATE_STACK];
    accumulate_work work = { .bands = bands, .lights = lights, .element = element, .live = live };
    accumulate_divide(&work, accumulate_lent(scratch, stack));
    if (bands <= LMPI_TABLE_MONIC_BANDS)
        accumulate_tiles(&work, 1, point, out);
    else
        accumulate_tiles(&work, 0, point, out);
}

/* Numbers of points that count as few, as measured (16 lanes leave them to AVX2), and the bands
 * whose sums fit the stack. */
#define FEW_POINTS(bands)                                                                          \
    (LMPI_LANES == 1               ? 0                                                             \
     : LMPI_LANES == 4             ? (bands) <= 10 ? 2 : 1                                         \
     : (bands) < 5 || (bands) > 10 ? 4                                                             \
                                   : 5)
#define FEW_BANDS 32

/* Whether `live` points cost less one by one, as measured: all points of a block cost as much as
 * one. */
LMPI_INLINE int few_pays(int bands, size_t lights, size_t live) {
    return bands <= FEW_BANDS && live <= FEW_POINTS(bands) && 4 * live <= lights + 8;
}

#endif
