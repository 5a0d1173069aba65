/* SPDX-License-Identifier: MIT */
/* shade_zonal_tmpl.h - shades lobes of surfaces under lights: the diffuse one by its closed form,
 * Phong's summed over bands (zonal_sums_tmpl.h).
 *
 * A tile is a block of surfaces under many lights or, where lights are few, several blocks under
 * them. First it computes the caps of all and their R_l, then lobe after lobe, several pairs of a
 * light and a block side by side, of different lights or of different blocks. */
#ifndef LAMPION_KERNELS_SHADE_ZONAL_TMPL_H
#define LAMPION_KERNELS_SHADE_ZONAL_TMPL_H

#include "src/kernels/shade_tmpl.h"
#include "src/kernels/zonal_sums_tmpl.h"

/* A light seen from a block of surfaces: the axis of its cap of at most a hemisphere, the weight of
 * a lobe's sum over bands (and of the diffuse lobe's clipped cosine), the weight of its term l = 0,
 * and t and ambient as in shade_direction; `ambient` is 0 where there is none. */
typedef struct zonal_pair {
    vf axis[3], of_sum, of_whole, t, ambient;
} zonal_pair;

/* Blocks of a tile where lights are few: a divisor of the number of blocks in most calls. */
#define ZONAL_BLOCKS 3

/* Pairs of a tile; and memory for rows of one number per band, weights of lobes and R_l of pairs,
 * of which ZONAL_CACHED fit the first-level cache. */
#define ZONAL_PAIRS  (LMPI_LANES == 16 ? 8 : 24)
#define ZONAL_MEMORY ((LMPI_LANES == 16 ? 4 : 5) * LMP_BANDS_MAX)
#define ZONAL_CACHED ((int)(24576 / sizeof(vf)))

/* A call, and its memory. */
typedef struct zonal_work {
    const zonal_tables *tables;
    const lmpi_kernel_surfaces *surfaces;
    const lmpi_packed_light *lights;
    size_t light_count, count;
    int plain; /* whether no light fades */
    const lmpi_kernel_accumulated *accumulated;
    int blocks;      /* blocks of a tile, 1 or ZONAL_BLOCKS */
    int lobes;       /* lobes whose weights fit at once */
    size_t together; /* lights of a tile */
    zonal_pair *pairs;
    vf *memory;
} zonal_work;

LMPI_INLINE vf *zonal_weights(int bands, const zonal_work *work, int row, int block) {
    return work->memory + (ptrdiff_t)(row * work->blocks + block) * bands;
}

LMPI_INLINE vf *zonal_r(int bands, const zonal_work *work, size_t pair) {
    return work->memory + ((size_t)(work->lobes * work->blocks) + pair) * (size_t)bands;
}

/* Computes the weights of a lobe, for blocks from surface e on. If `kept`, those of the block
 * before are still there. */
LMPI_INLINE void zonal_weigh(int bands, const zonal_work *work, int lobe, int row, size_t e,
                             int blocks, int kept) {
    const float *exponent = work->surfaces->lobe[lobe].exponent + e;
    for (int i = 0; i < blocks; i++, exponent += LMPI_LANES) {
        vf *weights = zonal_weights(bands, work, row, i);
        /* Neighbors often have the same material. */
        if ((i == 0 && !kept) || memcmp(exponent, exponent - LMPI_LANES, sizeof(vf)) != 0)
            zonal_phong(bands, work->tables->phong, vf_load(exponent), weights);
        else if (i > 0)
            memcpy(weights, weights - bands, (size_t)bands * sizeof *weights);
    }
}

/* Calls body(SIDE BY SIDE, first, …) for all of `count` pairs, of which none goes alone unless it
 * is the only one. */
#define ZONAL_EACH(count, body, ...)                                                               \
    do {                                                                                           \
        size_t first = 0;                                                                          \
        for (; (count)-first >= 6 || (count)-first == 4; first += 4)                               \
            body(4, first, __VA_ARGS__);                                                           \
        if ((count)-first == 5 || (count)-first == 3) {                                            \
            body(3, first, __VA_ARGS__);                                                           \
            first += 3;                                                                            \
        }                                                                                          \
        if ((count)-first == 2)                                                                    \
            body(2, first, __VA_ARGS__);                                                           \
        if ((count)-first == 1)                                                                    \
            body(1, first, __VA_ARGS__);                                                           \
    } while (0)

LMPI_INLINE void zonal_radials(int side_by_side, size_t first, int bands, int monic,
                               const zonal_work *work) {
    const zonal_tables *tables = work->tables;
    vf t[ZONAL_SIDE_BY_SIDE], *r[ZONAL_SIDE_BY_SIDE];
    LMPI_OPAQUE(tables);
    LMPI_UNROLL for (int i = 0; i < side_by_side; i++) {
        t[i] = work->pairs[first + (size_t)i].t;
        r[i] = zonal_r(bands, work, first + (size_t)i);
    }
    zonal_radial(side_by_side, bands, monic, tables, t, r);
}

/* Finds all pairs of a tile, light after light, each with all blocks; returns whether there is
 * ambient light. */
LMPI_INLINE int zonal_caps(int bands, int monic, const zonal_work *work,
                           const lmpi_packed_light *lights, size_t light_count, size_t e,
                           int blocks) {
    int is_ambient = 0;
    for (int b = 0; b < blocks; b++) {
        const size_t block = e + (size_t)b * LMPI_LANES;
        vf point[3];
        shade_planes(&work->surfaces->point, block, point);
        for (size_t i = 0; i < light_count; i++) {
            zonal_pair *to = &work->pairs[i * (size_t)blocks + (size_t)b];
            shade_direction direction = { .ambient = vf_set(0) };
            const cap_lanes cap = shade_cap(&lights[i], work->plain, point, &direction);
            to->axis[0] = cap.x * cap.per_d;
            to->axis[1] = cap.y * cap.per_d;
            to->axis[2] = cap.z * cap.per_d;
            to->of_sum = direction.weight * (vf_set(2) - direction.t);
            to->of_whole = direction.weight;
            to->t = direction.t;
            to->ambient = direction.ambient;
            is_ambient |= direction.is_ambient;
        }
    }
    if (work->lobes > 0)
        ZONAL_EACH((size_t)blocks * light_count, zonal_radials, bands, monic, work);
    return is_ambient;
}

/* Adds a lobe's response, given its sum from l = 1 on and its term l = 0. */
LMPI_INLINE void zonal_add(const zonal_pair *pair, int is_ambient, const lmp_rgb *rgb, vf sum,
                           vf whole, vf sums[3]) {
    vf response = pair->of_sum * sum + pair->of_whole * whole;
    if (__builtin_expect(is_ambient, 0))
        response = response + 2 * whole * pair->ambient;
    shade_accumulate(rgb, response, sums);
}

/* Clips by the horizon the cosines of those lights that it cuts, one light every `blocks` pairs. A
 * loop of its own, so that the numbers of the closed form are loaded once for all lights, and
 * surfaces whose horizon cuts no light keep their registers. */
static LMPI_NOINLINE void zonal_clip(const zonal_pair *pairs, size_t blocks, size_t count,
                                     vf *cosines) {
    for (size_t i = 0; i < count; i++) {
        const vf t = pairs[i * blocks].t;
        if (shade_is_cut(cosines[i], t))
            cosines[i] = shade_clip(cosines[i], t);
    }
}

/* Adds what the diffuse lobe receives, block after block. */
LMPI_INLINE void zonal_diffuse(int blocks, const zonal_work *work, const lmpi_packed_light *lights,
                               size_t light_count, int is_ambient, size_t e) {
    for (int b = 0; b < blocks; b++) {
        const size_t block = e + (size_t)b * LMPI_LANES;
        const zonal_pair *pairs = work->pairs + b;
        vf normal[3], sums[3], cosines[ZONAL_PAIRS];
        int is_cut = 0;
        shade_planes(&work->surfaces->normal, block, normal);
        for (size_t i = 0; i < light_count; i++) {
            const zonal_pair *pair = &pairs[i * (size_t)blocks];
            cosines[i] =
                normal[0] * pair->axis[0] + normal[1] * pair->axis[1] + normal[2] * pair->axis[2];
            is_cut |= shade_is_cut(cosines[i], pair->t);
        }
        if (__builtin_expect(is_cut, 0))
            zonal_clip(pairs, (size_t)blocks, light_count, cosines);
        shade_sums_load(work->accumulated->diffuse, block, sums);
        for (size_t i = 0; i < light_count; i++) {
            const zonal_pair *pair = &pairs[i * (size_t)blocks];
            vf response = pair->of_sum * vf_max(vf_set(0), cosines[i]);
            if (__builtin_expect(is_ambient, 0))
                response = response + pair->ambient;
            shade_accumulate(&lights[i].color, response, sums);
        }
        shade_sums_store(sums, block, work->accumulated->diffuse);
    }
}

/* A Phong lobe of a tile from surface e on: its axes, the row of its weights, its sums, and the
 * lights, with is_ambient if some are ambient. */
typedef struct zonal_lobe {
    const lmpi_kernel_vec3 *axes;
    int row;
    float *const *to;
    const lmpi_packed_light *lights;
    int is_ambient;
    size_t e;
} zonal_lobe;

/* Adds some pairs from `first` on: several lights of one block, or one light and all blocks. */
LMPI_INLINE void zonal_some(int side_by_side, size_t first, int blocks, int bands, int monic,
                            const zonal_work *work, const zonal_lobe *lobe) {
    const zonal_tables *tables = work->tables;
    const zonal_pair *pairs = work->pairs + first;
    const vf *r[ZONAL_SIDE_BY_SIDE], *weights[ZONAL_SIDE_BY_SIDE];
    vf axis[3], v[ZONAL_SIDE_BY_SIDE], sum[ZONAL_SIDE_BY_SIDE], sums[3];
    LMPI_OPAQUE(tables);
    LMPI_UNROLL for (int i = 0; i < side_by_side; i++) {
        const int block = blocks > 1 ? i : 0;
        if (i == 0 || blocks > 1)
            shade_planes(lobe->axes, lobe->e + (size_t)block * LMPI_LANES, axis);
        v[i] = axis[0] * pairs[i].axis[0] + axis[1] * pairs[i].axis[1] + axis[2] * pairs[i].axis[2];
        r[i] = zonal_r(bands, work, first + (size_t)i);
        weights[i] = zonal_weights(bands, work, lobe->row, block);
    }
    zonal_phong_sum(side_by_side, bands, monic, tables, weights, r, v, sum);
    LMPI_UNROLL for (int i = 0; i < side_by_side; i++) {
        const size_t e = lobe->e + (blocks > 1 ? (size_t)i * LMPI_LANES : 0);
        const lmpi_packed_light *light =
            &lobe->lights[blocks > 1 ? first / ZONAL_BLOCKS : first + (size_t)i];
        if (i == 0 || blocks > 1)
            shade_sums_load(lobe->to, e, sums);
        zonal_add(&pairs[i], lobe->is_ambient, &light->color, sum[i], weights[i][0], sums);
        if (i == side_by_side - 1 || blocks > 1)
            shade_sums_store(sums, e, lobe->to);
    }
}

LMPI_INLINE void zonal_pairs(int blocks, int bands, int monic, const zonal_work *work,
                             const zonal_lobe *lobe, size_t light_count) {
    if (blocks > 1)
        for (size_t i = 0; i < light_count; i++)
            zonal_some(ZONAL_BLOCKS, i * ZONAL_BLOCKS, blocks, bands, monic, work, lobe);
    else
        ZONAL_EACH(light_count, zonal_some, blocks, bands, monic, work, lobe);
}

/* Shades a tile. Where the weights of all lobes do not fit at once, it loops over the lights again
 * for the rest. */
LMPI_INLINE void zonal_tile(int blocks, int bands, int monic, const zonal_work *work, size_t e,
                            int kept) {
    const lmpi_kernel_surfaces *surfaces = work->surfaces;
    const lmpi_kernel_accumulated *to = work->accumulated;
    int first = 0;
    do {
        const int left = surfaces->lobe_count - first;
        const int lobes = left < work->lobes ? left : work->lobes;
        for (int k = 0; k < lobes; k++)
            zonal_weigh(bands, work, first + k, k, e, blocks, kept);
        for (size_t i = 0, taken; i < work->light_count; i += taken) {
            const lmpi_packed_light *lights = work->lights + i;
            const size_t rest = work->light_count - i;
            taken = rest < work->together ? rest : work->together;
            const int is_ambient = zonal_caps(bands, monic, work, lights, taken, e, blocks);
            if (first == 0)
                zonal_diffuse(blocks, work, lights, taken, is_ambient, e);
            for (int k = 0; k < lobes; k++) {
                const zonal_lobe lobe = { &surfaces->lobe[first + k].axis,
                                          k,
                                          to->specular[first + k],
                                          lights,
                                          is_ambient,
                                          e };
                zonal_pairs(blocks, bands, monic, work, &lobe, taken);
            }
        }
        first += work->lobes;
    } while (first < surfaces->lobe_count);
}

LMPI_INLINE void zonal_tiles(int bands, int monic, const zonal_work *work) {
    const size_t several = ZONAL_BLOCKS * LMPI_LANES;
    const int all = work->surfaces->lobe_count <= work->lobes && work->blocks == 1;
    size_t e = 0;
    if (work->blocks > 1)
        for (; e + several <= work->count; e += several)
            zonal_tile(ZONAL_BLOCKS, bands, monic, work, e, 0);
    for (; e < work->count; e += LMPI_LANES)
        zonal_tile(1, bands, monic, work, e, all && e > 0);
}

/* Functions of their own for each small number of bands, as straight-line code, and for more bands:
 * in one function, compilers do not find registers for all. */
#define ZONAL_OF(bands)                                                                            \
    static LMPI_NOINLINE void zonal_of_##bands(const zonal_work *work) {                           \
        zonal_tiles(bands, 1, work);                                                               \
    }
#ifndef LMPI_ROLLED_LOOPS
ZONAL_OF(3)
ZONAL_OF(4)
ZONAL_OF(5)
ZONAL_OF(6)
ZONAL_OF(7)
ZONAL_OF(8)
ZONAL_OF(9)
ZONAL_OF(10)
#endif
#undef ZONAL_OF

static LMPI_NOINLINE void zonal_of_more(int bands, const zonal_work *work) {
    zonal_tiles(bands, 1, work);
}

static LMPI_NOINLINE void zonal_of_many(int bands, const zonal_work *work) {
    zonal_tiles(bands, 0, work);
}

static inline void zonal_of(int bands, const zonal_work *work) {
#define ZONAL_CASE(bands)                                                                          \
    case bands:                                                                                    \
        zonal_of_##bands(work);                                                                    \
        return
    switch (bands) {
#ifndef LMPI_ROLLED_LOOPS
        ZONAL_CASE(3);
        ZONAL_CASE(4);
        ZONAL_CASE(5);
        ZONAL_CASE(6);
        ZONAL_CASE(7);
        ZONAL_CASE(8);
        ZONAL_CASE(9);
        ZONAL_CASE(10);
#endif
    default:
        if (bands <= ZONAL_MONIC_BANDS)
            zonal_of_more(bands, work);
        else
            zonal_of_many(bands, work);
    }
#undef ZONAL_CASE
}

/* Divides the memory: under few lights among several blocks, if they fit; otherwise among the
 * weights of as many lobes, and as many lights, as fit. */
static inline void zonal_divide(int bands, zonal_work *work) {
    const int rows = ZONAL_MEMORY / bands, all = work->surfaces->lobe_count;
    const int cached = rows < ZONAL_CACHED / bands ? rows : ZONAL_CACHED / bands;
    const int some = rows < ZONAL_SIDE_BY_SIDE + 2 ? 2 : ZONAL_SIDE_BY_SIDE;
    const size_t few = work->light_count;
    if (few < 2 * ZONAL_SIDE_BY_SIDE && few % ZONAL_SIDE_BY_SIDE != 0 &&
        ZONAL_BLOCKS * all + ZONAL_PAIRS <= rows) {
        work->blocks = ZONAL_BLOCKS;
        work->lobes = all;
        work->together = ZONAL_PAIRS / ZONAL_BLOCKS;
        return;
    }
    work->blocks = 1;
    work->lobes = all < rows - some ? all : rows - some;
    const int left = cached - work->lobes;
    work->together = (size_t)(left > ZONAL_PAIRS ? ZONAL_PAIRS
                              : left < some      ? some
                                                 : left / some * some);
}

static void kernel_shade_zonal(int bands, const float *window, const lmpi_kernel_surfaces *surfaces,
                               const lmpi_packed_light *lights, size_t light_count, size_t count,
                               const lmpi_kernel_accumulated *accumulated) {
    zonal_tables tables;
    zonal_pair pairs[ZONAL_PAIRS];
    vf memory[ZONAL_MEMORY];
    zonal_work work = { .tables = &tables,
                        .surfaces = surfaces,
                        .lights = lights,
                        .light_count = light_count,
                        .count = count,
                        .plain = shade_are_plain(lights, light_count),
                        .accumulated = accumulated,
                        .pairs = pairs,
                        .memory = memory };
    const int padded = bands < ZONAL_BANDS_MIN ? ZONAL_BANDS_MIN : bands;
    zonal_divide(padded, &work);
    zonal_prepare(bands, bands <= ZONAL_MONIC_BANDS, window, &tables);
    zonal_of(padded, &work);
}

#endif
