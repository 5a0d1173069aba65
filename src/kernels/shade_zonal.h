/* SPDX-License-Identifier: MIT */
/* shade_zonal.h - lobes summed over bands, by recurrences in the angles of light and lobes. */
#ifndef LAMPION_KERNELS_SHADE_ZONAL_H
#define LAMPION_KERNELS_SHADE_ZONAL_H

#include "src/kernels/shade.h"

/* Up to so many bands all recurrences run in monic form, x p_(l-1) - c_l p_(l-2): the product of
 * two monic polynomials then stays a normal float. */
#define ZONAL_MONIC_BANDS 48

/* A number that is the same for every surface, as an operand in memory that costs no instruction:
 * AVX-512 broadcasts it as it is read, the others read it broadcast. */
#if LMP_LANES == 16
typedef float zonal_number;
#define zonal_number_of(number) (number)
#define zonal_lanes(number)     vf_set(number)
#else
typedef vf zonal_number;
#define zonal_number_of(number) vf_set(number)
#define zonal_lanes(number)     (number)
#endif

/* Fewer bands are padded by some of weight 0. */
#define ZONAL_BANDS_MIN 3

/* Lights that go through the bands of a lobe side by side. */
#define ZONAL_SIDE_BY_SIDE 4

/* What is the same for every surface, by band. The factors of R_l P_l hold their norms, of l = 0
 * those of strength and solid angle, which are pi (1 + |cos a|) and 2 pi times a direction's
 * weight. Even bands of the diffuse lobe, l = 2k, take two steps at once: P_l = (even_a u² -
 * even_b) P_(l-2) - even_c P_(l-4), even_a = 1 in monic form. */
typedef struct zonal_tables {
    float phong[LMP_BANDS_MAX];
    zonal_number cap[ZONAL_MONIC_BANDS], lobe[ZONAL_MONIC_BANDS]; /* c_l; only in monic form */
    zonal_number even_b[ZONAL_MONIC_BANDS / 2 + 1], even_c[ZONAL_MONIC_BANDS / 2 + 1]; /* too */
    zonal_number diffuse_1; /* of l = 1; of even l: */
    zonal_number diffuse[LMP_BANDS_MAX / 2];
} zonal_tables;

static inline void zonal_prepare(int bands, int monic, const float *window, const float *diffuse,
                                 zonal_tables *tables) {
    for (int l = 0; l < bands || l < ZONAL_BANDS_MIN; l++) {
        const double factor = l < bands ? lmp_table_zonal_scale[monic][l] * (double)window[l] : 0;
        const float of_diffuse = l < bands ? (float)(factor * (double)diffuse[l]) : 0;
        tables->phong[l] = (float)factor;
        if (monic) {
            tables->cap[l] = zonal_number_of(lmp_table_zonal_cap[l]);
            tables->lobe[l] = zonal_number_of(lmp_table_zonal_lobe[l]);
            tables->even_b[l / 2] = zonal_number_of(lmp_table_even_b[1][l / 2]);
            tables->even_c[l / 2] = zonal_number_of(lmp_table_even_c[1][l / 2]);
        }
        if (l == 1)
            tables->diffuse_1 = zonal_number_of(of_diffuse);
        if (l % 2 == 0)
            tables->diffuse[l / 2] = zonal_number_of(of_diffuse);
    }
}

/* lambda_l = lambda_(l-2) (e - l + 2) / (e + l + 1), of the lobe that integrates to 1. */
LMP_INLINE void zonal_phong(int bands, const zonal_tables *tables, vf exponent, vf *weights) {
    vf before = vf_set(1), lambda = (exponent + 1) / (exponent + 2);
    weights[0] = before * tables->phong[0];
    LMP_ROLLED for (int l = 1; l < bands || l < ZONAL_BANDS_MIN; l++) {
        weights[l] = lambda * tables->phong[l];
        const vf next = before * ((exponent - (float)(l - 1)) / (exponent + (float)(l + 2)));
        before = lambda;
        lambda = next;
    }
}

/* --- a lobe under a light ----------------------------------------------------------------------
 *
 * A sum of a_l P_l goes from the last band to the first (Clenshaw): where P_l = x_l P_(l-1) - c_l
 * P_(l-2), y_l = a_l + x_(l+1) y_(l+1) - c_(l+2) y_(l+2). That spares a product a band, and two
 * registers, of a sum beside P_l. */

/* R_l of caps for l >= 2, R_1 = 1 (t: shade_direction): by itself in monic form; else by its
 * differences, which keeps more bands exact. */
LMP_INLINE void zonal_radial(int lights, int bands, int monic, const zonal_tables *tables,
                             const vf *t, vf *const *r) {
    vf r1[ZONAL_SIDE_BY_SIDE], r0[ZONAL_SIDE_BY_SIDE], x[ZONAL_SIDE_BY_SIDE];
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        x[i] = vf_set(1) - t[i];
        r0[i] = monic ? vf_set(1) : vf_set(0);
        r1[i] = vf_set(1);
        if (monic) {
            r[i][2] = x[i];
            r1[i] = x[i];
        }
    }
    if (monic) {
        LMP_UNROLL for (int l = 3; l < bands; l++) {
            LMP_UNROLL for (int i = 0; i < lights; i++) {
                const vf r2 = x[i] * r1[i] - tables->cap[l] * r0[i];
                r0[i] = r1[i];
                r1[i] = r2;
                r[i][l] = r2;
            }
        }
        return;
    }
    LMP_ROLLED for (int l = 2; l < bands; l++) {
        LMP_UNROLL for (int i = 0; i < lights; i++) {
            r0[i] = lmp_table_cap_d[l] * r0[i] - lmp_table_cap_t[l] * (t[i] * r1[i]);
            r1[i] = r1[i] + r0[i];
            r[i][l] = r1[i];
        }
    }
}

/* x_l and c_l of P_l(v). */
LMP_INLINE vf zonal_x(int monic, int l, vf v) {
    return monic ? v : lmp_table_legendre_t[l] * v;
}

LMP_INLINE vf zonal_c(int monic, const zonal_tables *tables, int l) {
    return monic ? zonal_lanes(tables->lobe[l]) : vf_set(lmp_table_legendre_d[l]);
}

/* The same of P_2k(u), square = u². */
LMP_INLINE vf zonal_even_x(int monic, const zonal_tables *tables, int k, vf square) {
    return monic ? square - tables->even_b[k]
                 : lmp_table_even_a[0][k] * square - lmp_table_even_b[0][k];
}

LMP_INLINE vf zonal_even_c(int monic, const zonal_tables *tables, int k) {
    return monic ? zonal_lanes(tables->even_c[k]) : vf_set(lmp_table_even_c[0][k]);
}

/* The sum of a Phong lobe from l = 1 on, of lights side by side: each waits for itself. */
LMP_INLINE void zonal_phong_sum(int lights, int bands, int monic, const zonal_tables *tables,
                                const vf *const *weights, const vf *const *r, const vf *v,
                                vf *sums) {
    vf y2[ZONAL_SIDE_BY_SIDE], y1[ZONAL_SIDE_BY_SIDE];
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        y2[i] = vf_set(0);
        y1[i] = weights[i][bands - 1] * r[i][bands - 1];
    }
    LMP_UNROLL for (int l = bands - 2; l >= 1; l--) {
        LMP_UNROLL for (int i = 0; i < lights; i++) {
            vf own = l > 1 ? weights[i][l] * r[i][l] : weights[i][1];
            if (l < bands - 2)
                own = own - zonal_c(monic, tables, l + 2) * y2[i];
            y2[i] = y1[i];
            y1[i] = own + zonal_x(monic, l + 1, v[i]) * y1[i];
        }
    }
    LMP_UNROLL for (int i = 0; i < lights; i++) sums[i] =
        v[i] * y1[i] - zonal_c(monic, tables, 2) * y2[i];
}

/* The diffuse one's, u the cosines with the normal. */
LMP_INLINE void zonal_diffuse_sum(int lights, int bands, int monic, const zonal_tables *tables,
                                  const vf *const *r, const vf *u, vf *sums) {
    vf square[ZONAL_SIDE_BY_SIDE], y2[ZONAL_SIDE_BY_SIDE], y1[ZONAL_SIDE_BY_SIDE];
    const int last = (bands - 1) / 2;
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        square[i] = u[i] * u[i];
        y2[i] = vf_set(0);
        y1[i] = tables->diffuse[last] * r[i][2 * last];
    }
    LMP_UNROLL for (int k = last - 1; k >= 1; k--) {
        LMP_UNROLL for (int i = 0; i < lights; i++) {
            const vf own = tables->diffuse[k] * r[i][2 * k];
            const vf rest = k == last - 1 ? own : own - zonal_even_c(monic, tables, k + 2) * y2[i];
            y2[i] = y1[i];
            y1[i] = rest + zonal_even_x(monic, tables, k + 1, square[i]) * y1[i];
        }
    }
    LMP_UNROLL for (int i = 0; i < lights; i++) {
        const vf sum = tables->diffuse_1 * u[i] + zonal_even_x(monic, tables, 1, square[i]) * y1[i];
        sums[i] = last == 1 ? sum : sum - zonal_even_c(monic, tables, 2) * y2[i];
    }
}

/* --- surfaces under lights ---------------------------------------------------------------------
 *
 * A tile is a block of surfaces under many lights or, where lights are few, several blocks under
 * them. First come the caps of all and their R_l, then lobe after lobe: pairs of a light and a
 * block side by side, of different lights or of different blocks. */

/* A light seen from a block of surfaces: the axis of its cap of at most a hemisphere, the weights
 * of a lobe's sum over bands and of its number of l = 0, and what else shade_direction says;
 * `ambient` is 0 where there is none. */
typedef struct zonal_pair {
    vf axis[3], of_sum, of_whole, t, ambient;
} zonal_pair;

/* Pairs of a tile; and memory for rows of as many numbers as there are bands: weights of lobes, and
 * R_l of pairs, which the first cache should hold. */
/* Blocks of a tile where lights are few: a divisor of those that most calls have. */
#define ZONAL_BLOCKS 3

#define ZONAL_PAIRS  (LMP_LANES == 16 ? 8 : 24)
#define ZONAL_MEMORY ((LMP_LANES == 16 ? 4 : 5) * LMP_BANDS_MAX)
#define ZONAL_CACHED ((int)(24576 / sizeof(vf)))

/* A call, and its memory. */
typedef struct zonal_work {
    const zonal_tables *tables;
    const lmp_kernel_surfaces *surfaces;
    const lmp_kernel_light *lights;
    size_t light_count, count;
    int plain; /* the lights */
    const lmp_kernel_accumulated *accumulated;
    int blocks;      /* of a tile, 1 or ZONAL_BLOCKS */
    int lobes;       /* whose weights have room at once */
    size_t together; /* lights of a tile */
    zonal_pair *pairs;
    vf *memory;
} zonal_work;

LMP_INLINE vf *zonal_weights(int bands, const zonal_work *work, int place, int block) {
    return work->memory + (ptrdiff_t)(place * work->blocks + block) * bands;
}

LMP_INLINE vf *zonal_r(int bands, const zonal_work *work, size_t pair) {
    return work->memory + ((size_t)(work->lobes * work->blocks) + pair) * (size_t)bands;
}

/* The weights of a lobe, of blocks from surface e on; those of the block before are there, if
 * `kept`. */
LMP_INLINE void zonal_weigh(int bands, const zonal_work *work, int lobe, int place, size_t e,
                            int blocks, int kept) {
    const float *exponent = work->surfaces->lobe[lobe].exponent + e;
    for (int i = 0; i < blocks; i++, exponent += LMP_LANES) {
        vf *weights = zonal_weights(bands, work, place, i);
        /* Neighbors are often of one material. */
        if ((i == 0 && !kept) || memcmp(exponent, exponent - LMP_LANES, sizeof(vf)) != 0)
            zonal_phong(bands, work->tables, vf_load(exponent), weights);
        else if (i > 0)
            memcpy(weights, weights - bands, (size_t)bands * sizeof *weights);
    }
}

/* Calls body(SIDE BY SIDE, first, …) for all of `count` pairs. None goes alone but one of one. */
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

LMP_INLINE void zonal_radials(int side_by_side, size_t first, int bands, int monic,
                              const zonal_work *work) {
    const zonal_tables *tables = work->tables;
    vf t[ZONAL_SIDE_BY_SIDE], *r[ZONAL_SIDE_BY_SIDE];
    LMP_OPAQUE(tables);
    LMP_UNROLL for (int i = 0; i < side_by_side; i++) {
        t[i] = work->pairs[first + (size_t)i].t;
        r[i] = zonal_r(bands, work, first + (size_t)i);
    }
    zonal_radial(side_by_side, bands, monic, tables, t, r);
}

/* All pairs of a tile: light after light, of each all blocks. Whether there is ambient light. */
LMP_INLINE int zonal_caps(int bands, int monic, const zonal_work *work,
                          const lmp_kernel_light *lights, size_t light_count, size_t e,
                          int blocks) {
    int is_ambient = 0;
    for (int b = 0; b < blocks; b++) {
        const size_t block = e + (size_t)b * LMP_LANES;
        vf point[3];
        shade_planes(&work->surfaces->point, block, point);
        for (size_t i = 0; i < light_count; i++) {
            zonal_pair *to = &work->pairs[i * (size_t)blocks + (size_t)b];
            shade_direction direction = { .ambient = vf_set(0) };
            const cap_lanes cap = shade_cap(&lights[i], work->plain, block, point, &direction);
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
    ZONAL_EACH((size_t)blocks * light_count, zonal_radials, bands, monic, work);
    return is_ambient;
}

/* Adds a lobe's response, of its sum from l = 1 on and its number of l = 0. */
LMP_INLINE void zonal_add(const zonal_pair *pair, int is_ambient, const lmp_rgb *rgb, vf sum,
                          vf whole, vf sums[3]) {
    vf response = pair->of_sum * sum + pair->of_whole * whole;
    if (__builtin_expect(is_ambient, 0))
        response = response + 2 * whole * pair->ambient;
    sums[0] = sums[0] + rgb->r * response;
    sums[1] = sums[1] + rgb->g * response;
    sums[2] = sums[2] + rgb->b * response;
}

/* A lobe of a tile from surface e on: its axes, where its weights are (none of the diffuse one),
 * what it adds to, and the lights, some of them ambient. */
typedef struct zonal_lobe {
    const lmp_kernel_vec3 *axes;
    int place;
    float *const *to;
    const lmp_kernel_light *lights;
    int is_ambient;
    size_t e;
} zonal_lobe;

/* Pairs from `first` on: of one block, or of one light and all blocks. */
LMP_INLINE void zonal_some(int side_by_side, size_t first, int blocks, int bands, int monic,
                           int diffuse, const zonal_work *work, const zonal_lobe *lobe) {
    const zonal_tables *tables = work->tables;
    const zonal_pair *pairs = work->pairs + first;
    const vf *r[ZONAL_SIDE_BY_SIDE], *weights[ZONAL_SIDE_BY_SIDE];
    vf axis[3], v[ZONAL_SIDE_BY_SIDE], sum[ZONAL_SIDE_BY_SIDE], sums[3];
    LMP_OPAQUE(tables);
    LMP_UNROLL for (int i = 0; i < side_by_side; i++) {
        const int block = blocks > 1 ? i : 0;
        if (i == 0 || blocks > 1)
            shade_planes(lobe->axes, lobe->e + (size_t)block * LMP_LANES, axis);
        v[i] = axis[0] * pairs[i].axis[0] + axis[1] * pairs[i].axis[1] + axis[2] * pairs[i].axis[2];
        r[i] = zonal_r(bands, work, first + (size_t)i);
        weights[i] = diffuse ? NULL : zonal_weights(bands, work, lobe->place, block);
    }
    if (diffuse)
        zonal_diffuse_sum(side_by_side, bands, monic, tables, r, v, sum);
    else
        zonal_phong_sum(side_by_side, bands, monic, tables, weights, r, v, sum);
    LMP_UNROLL for (int i = 0; i < side_by_side; i++) {
        const size_t e = lobe->e + (blocks > 1 ? (size_t)i * LMP_LANES : 0);
        const lmp_kernel_light *light =
            &lobe->lights[blocks > 1 ? first / ZONAL_BLOCKS : first + (size_t)i];
        if (i == 0 || blocks > 1)
            shade_sums_load(lobe->to, e, sums);
        zonal_add(&pairs[i], lobe->is_ambient, &light->radiance, sum[i],
                  diffuse ? zonal_lanes(tables->diffuse[0]) : weights[i][0], sums);
        if (i == side_by_side - 1 || blocks > 1)
            shade_sums_store(sums, e, lobe->to);
    }
}

LMP_INLINE void zonal_pairs(int blocks, int bands, int monic, int diffuse, const zonal_work *work,
                            const zonal_lobe *lobe, size_t light_count) {
    if (blocks > 1)
        for (size_t i = 0; i < light_count; i++)
            zonal_some(ZONAL_BLOCKS, i * ZONAL_BLOCKS, blocks, bands, monic, diffuse, work, lobe);
    else
        ZONAL_EACH(light_count, zonal_some, blocks, bands, monic, diffuse, work, lobe);
}

/* A tile. Where the weights of all lobes have no room at once, lights go by again for the rest. */
LMP_INLINE void zonal_tile(int blocks, int bands, int monic, const zonal_work *work, size_t e,
                           int kept) {
    const lmp_kernel_surfaces *surfaces = work->surfaces;
    const lmp_kernel_accumulated *to = work->accumulated;
    for (int first = 0; first < surfaces->lobe_count; first += work->lobes) {
        const int left = surfaces->lobe_count - first;
        const int lobes = left < work->lobes ? left : work->lobes;
        for (int k = 0; k < lobes; k++)
            zonal_weigh(bands, work, first + k, k, e, blocks, kept);
        for (size_t i = 0, taken; i < work->light_count; i += taken) {
            const lmp_kernel_light *lights = work->lights + i;
            const size_t rest = work->light_count - i;
            taken = rest < work->together ? rest : work->together;
            const int is_ambient = zonal_caps(bands, monic, work, lights, taken, e, blocks);
            if (first == 0) {
                const zonal_lobe lobe = {
                    &surfaces->normal, 0, to->diffuse, lights, is_ambient, e
                };
                zonal_pairs(blocks, bands, monic, 1, work, &lobe, taken);
            }
            for (int k = 0; k < lobes; k++) {
                const zonal_lobe lobe = { &surfaces->lobe[first + k].axis,
                                          k,
                                          to->specular[first + k],
                                          lights,
                                          is_ambient,
                                          e };
                zonal_pairs(blocks, bands, monic, 0, work, &lobe, taken);
            }
        }
    }
}

LMP_INLINE void zonal_tiles(int bands, int monic, const zonal_work *work) {
    const size_t several = ZONAL_BLOCKS * LMP_LANES;
    const int all = work->surfaces->lobe_count <= work->lobes && work->blocks == 1;
    size_t e = 0;
    if (work->blocks > 1)
        for (; e + several <= work->count; e += several)
            zonal_tile(ZONAL_BLOCKS, bands, monic, work, e, 0);
    for (; e < work->count; e += LMP_LANES)
        zonal_tile(1, bands, monic, work, e, all && e > 0);
}

/* Rows have room for ZONAL_BANDS_MIN bands at least. */
LMP_INLINE void zonal_surfaces(int bands, int constant, const zonal_work *work) {
    const int padded = bands < ZONAL_BANDS_MIN ? ZONAL_BANDS_MIN : bands;
    if (constant || bands <= ZONAL_MONIC_BANDS)
        zonal_tiles(padded, 1, work);
    else
        zonal_tiles(padded, 0, work);
}

/* Under a sanitizer, which makes straight-line code of ten numbers of bands the work of minutes,
 * the code for any number does. */
#ifdef LMP_KERNELS_SANITIZED
#define ZONAL_SPECIALISE(bands, ...) zonal_surfaces(bands, 0, __VA_ARGS__);
#else
#define ZONAL_SPECIALISE(bands, ...) BASIS_SPECIALISE(bands, zonal_surfaces, __VA_ARGS__)
#endif

/* Under few lights several blocks, if there is room. Else the weights of as many lobes and as many
 * lights as there is room for. */
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

static void kernel_shade_zonal(int bands, const float *window, const float *diffuse,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *accumulated) {
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
    zonal_divide(bands < ZONAL_BANDS_MIN ? ZONAL_BANDS_MIN : bands, &work);
    zonal_prepare(bands, bands <= ZONAL_MONIC_BANDS, window, diffuse, &tables);
    ZONAL_SPECIALISE(bands, &work)
}

#endif
