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

/* What is the same for every surface, by band. The factors of R_l P_l hold their norms, of l = 0
 * those of strength and solid angle, which are pi (1 + |cos a|) and 2 pi times a direction's
 * weight. Even bands of the diffuse lobe take two steps at once: P_l = (even_a u² - even_b) P_(l-2)
 * - even_c P_(l-4), even_a = 1 in monic form. */
typedef struct zonal_tables {
    zonal_number phong[LMP_BANDS_MAX];
    zonal_number cap[ZONAL_MONIC_BANDS], lobe[ZONAL_MONIC_BANDS]; /* c_l; only in monic form */
    zonal_number diffuse_1;                                       /* of l = 1; of even l: */
    zonal_number diffuse[LMP_BANDS_MAX / 2];
    zonal_number even_a[LMP_BANDS_MAX / 2], even_b[LMP_BANDS_MAX / 2], even_c[LMP_BANDS_MAX / 2];
} zonal_tables;

static inline void zonal_prepare(int bands, int monic, const float *window, const float *diffuse,
                                 zonal_tables *tables) {
    for (int l = 0; l < bands || l < ZONAL_BANDS_MIN; l++) {
        const double factor = l < bands ? lmp_table_zonal_scale[monic][l] * (double)window[l] : 0;
        const float of_diffuse = l < bands ? (float)(factor * (double)diffuse[l]) : 0;
        tables->phong[l] = zonal_number_of((float)factor);
        if (monic) {
            tables->cap[l] = zonal_number_of(lmp_table_zonal_cap[l]);
            tables->lobe[l] = zonal_number_of(lmp_table_zonal_lobe[l]);
        }
        if (l == 1)
            tables->diffuse_1 = zonal_number_of(of_diffuse);
        if (l % 2 != 0)
            continue;
        tables->diffuse[l / 2] = zonal_number_of(of_diffuse);
        tables->even_a[l / 2] = zonal_number_of(lmp_table_even_a[monic][l / 2]);
        tables->even_b[l / 2] = zonal_number_of(lmp_table_even_b[monic][l / 2]);
        tables->even_c[l / 2] = zonal_number_of(lmp_table_even_c[monic][l / 2]);
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

/* Phong lobes that go through the bands together. More would not find registers. */
#define ZONAL_LOBES_MAX 3

/* The lobes' sums on their way through the bands: R_l, P_l of the normal (even l) and of each axis,
 * each with the one before. */
typedef struct zonal_sums {
    vf r1, r0, p1, p0, q1[ZONAL_LOBES_MAX], q0[ZONAL_LOBES_MAX];
    vf diffuse, specular[ZONAL_LOBES_MAX];
} zonal_sums;

LMP_INLINE void zonal_add_specular(int lobes, const vf (*weights)[LMP_BANDS_MAX], int l,
                                   zonal_sums *sums) {
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums->specular[k] = sums->specular[k] + weights[k][l] * (sums->r1 * sums->q1[k]);
        LMP_OPAQUE_LANES(sums->specular[k]);
    }
}

LMP_INLINE void zonal_add_diffuse(const zonal_tables *tables, int l, vf square, zonal_sums *sums) {
    const vf p2 = (square - tables->even_b[l / 2]) * sums->p1 - tables->even_c[l / 2] * sums->p0;
    sums->p0 = sums->p1;
    sums->p1 = p2;
    sums->diffuse = sums->diffuse + tables->diffuse[l / 2] * (sums->r1 * p2);
    LMP_OPAQUE_LANES(sums->diffuse);
}

/* Monic form, x = |cos a|. */
LMP_INLINE void zonal_step(int lobes, const zonal_tables *tables, int l, vf x, const vf *v,
                           zonal_sums *sums) {
    const vf r2 = x * sums->r1 - tables->cap[l] * sums->r0;
    sums->r0 = sums->r1;
    sums->r1 = r2;
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        const vf q2 = v[k] * sums->q1[k] - tables->lobe[l] * sums->q0[k];
        sums->q0[k] = sums->q1[k];
        sums->q1[k] = q2;
    }
}

/* v: of direction->v, the lobes'. */
LMP_INLINE zonal_sums zonal_monic(int lobes, int diffuse, int bands, const zonal_tables *tables,
                                  const vf (*weights)[LMP_BANDS_MAX],
                                  const shade_direction *direction, const vf *v) {
    const vf one = vf_set(1), square = direction->u * direction->u, x = one - direction->t;
    zonal_sums sums = { .r1 = x,
                        .r0 = one,
                        .p1 = square - tables->even_b[1],
                        .p0 = one,
                        .diffuse = tables->diffuse_1 * direction->u };
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums.q1[k] = v[k] * v[k] - tables->lobe[2];
        sums.q0[k] = v[k];
        sums.specular[k] = weights[k][1] * v[k];
    }
    if (diffuse)
        sums.diffuse = sums.diffuse + tables->diffuse[1] * (x * sums.p1);
    zonal_add_specular(lobes, weights, 2, &sums);
    LMP_UNROLL for (int l = 3; l < bands; l += 2) {
        zonal_step(lobes, tables, l, x, v, &sums);
        zonal_add_specular(lobes, weights, l, &sums);
        if (l + 1 == bands)
            break;
        zonal_step(lobes, tables, l + 1, x, v, &sums);
        zonal_add_specular(lobes, weights, l + 1, &sums);
        if (diffuse)
            zonal_add_diffuse(tables, l + 1, square, &sums);
    }
    return sums;
}

/* The same of more bands: R_l by its differences r0 = R_l - R_(l-1), which keeps more of them
 * exact. */
LMP_INLINE zonal_sums zonal_long(int lobes, int diffuse, int bands, const zonal_tables *tables,
                                 const vf (*weights)[LMP_BANDS_MAX],
                                 const shade_direction *direction, const vf *v) {
    const vf one = vf_set(1), zero = vf_set(0), square = direction->u * direction->u;
    zonal_sums sums = { one, zero, one, zero, .diffuse = tables->diffuse_1 * direction->u };
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums.q1[k] = v[k];
        sums.q0[k] = one;
        sums.specular[k] = weights[k][1] * v[k];
    }
    LMP_ROLLED for (int l = 2; l < bands; l++) {
        const float *d = lmp_table_legendre_d, *t = lmp_table_legendre_t;
        sums.r0 = lmp_table_cap_d[l] * sums.r0 - lmp_table_cap_t[l] * (direction->t * sums.r1);
        sums.r1 = sums.r1 + sums.r0;
        LMP_UNROLL for (int k = 0; k < lobes; k++) {
            const vf q2 = t[l] * (v[k] * sums.q1[k]) - d[l] * sums.q0[k];
            sums.q0[k] = sums.q1[k];
            sums.q1[k] = q2;
        }
        zonal_add_specular(lobes, weights, l, &sums);
        if (diffuse && l % 2 == 0)
            zonal_add_diffuse(tables, l, tables->even_a[l / 2] * square, &sums);
    }
    return sums;
}

/* A lobe's response, of its sum from l = 1 on and its number of l = 0. */
LMP_INLINE vf zonal_response(const shade_direction *direction, vf sum, vf whole) {
    const vf response = direction->weight * ((vf_set(2) - direction->t) * sum + whole);
    return __builtin_expect(direction->is_ambient, 0) ? response + 2 * whole * direction->ambient
                                                      : response;
}

/* What a block of surfaces accumulates. */
typedef struct zonal_accumulated {
    vf diffuse[3], specular[ZONAL_LOBES_MAX][3];
} zonal_accumulated;

/* Adds one light's responses. The chains of successive lights run side by side: none waits for the
 * one before. */
LMP_INLINE void zonal_light(int lobes, int diffuse, int bands, int monic,
                            const zonal_tables *tables, const vf (*weights)[LMP_BANDS_MAX],
                            const shade_direction *direction, const vf *v, lmp_rgb rgb,
                            zonal_accumulated *to) {
    const zonal_sums zonal = monic
                                 ? zonal_monic(lobes, diffuse, bands, tables, weights, direction, v)
                                 : zonal_long(lobes, diffuse, bands, tables, weights, direction, v);
    if (diffuse)
        shade_accumulate(rgb,
                         zonal_response(direction, zonal.diffuse, zonal_lanes(tables->diffuse[0])),
                         to->diffuse);
    LMP_UNROLL for (int k = 0; k < lobes; k++) shade_accumulate(
        rgb, zonal_response(direction, zonal.specular[k], weights[k][0]), to->specular[k]);
}

/* Lights that go by together: all their caps first, then their lobes, which take turns at waiting.
 */
#define ZONAL_LIGHTS_ONE  LMP_KERNEL_LIGHTS_MAX /* of surfaces with one lobe */
#define ZONAL_LIGHTS_MORE 16

/* A call, and its memory: of lights that go by together, and of R_l P_l of lobes, by band. */
typedef struct zonal_work {
    const zonal_tables *tables;
    const lmp_kernel_surfaces *surfaces;
    const lmp_kernel_light *lights;
    size_t light_count, count;
    int plain; /* the lights */
    const lmp_kernel_accumulated *accumulated;
    shade_direction *directions;
    vf *v, (*weights)[LMP_BANDS_MAX];
} zonal_work;

/* The weights of Phong's lobes from `first` on; those of the block before are there, if `kept`. */
LMP_INLINE void zonal_weigh(int first, int lobes, int bands, const zonal_work *work, size_t e,
                            int kept, vf (*weights)[LMP_BANDS_MAX]) {
    for (int k = 0; k < lobes; k++) {
        const float *exponent = work->surfaces->lobe[first + k].exponent + e;
        /* Neighbors are often of one material. */
        if (!kept || memcmp(exponent, exponent - LMP_LANES, sizeof(vf)) != 0)
            zonal_phong(bands, work->tables, vf_load(exponent), weights[k]);
    }
}

/* `count` lights from `light` on, on Phong's lobes from `first` on, of these weights, and on the
 * diffuse one; `all` lobes have cosines. */
LMP_INLINE void zonal_lobes(int first, int lobes, int all, int diffuse, int bands, int monic,
                            const zonal_work *work, const vf (*weights)[LMP_BANDS_MAX],
                            size_t light, size_t count, size_t e) {
    const lmp_kernel_accumulated *accumulated = work->accumulated;
    const zonal_tables *tables = work->tables;
    zonal_accumulated sums;
    if (diffuse)
        shade_sums_load(accumulated->diffuse, e, sums.diffuse);
    LMP_UNROLL for (int k = 0; k < lobes; k++)
        shade_sums_load(accumulated->specular[first + k], e, sums.specular[k]);
    for (size_t i = 0; i < count; i++) {
        LMP_OPAQUE(tables);
        zonal_light(lobes, diffuse, bands, monic, tables, weights, &work->directions[i],
                    work->v + i * (size_t)all + first, work->lights[light + i].radiance, &sums);
    }
    if (diffuse)
        shade_sums_store(sums.diffuse, e, accumulated->diffuse);
    LMP_UNROLL for (int k = 0; k < lobes; k++)
        shade_sums_store(sums.specular[k], e, accumulated->specular[first + k]);
}

/* Where there are more lobes than go together, the weights of both groups are kept for all lights
 * in the halves of rows, if they fit; else they take turns. */
LMP_INLINE void zonal_all(int lobes, int bands, int monic, const zonal_work *work) {
    typedef const vf(*rows)[LMP_BANDS_MAX];
    const lmp_kernel_light *lights = work->lights;
    const int more = lobes == ZONAL_LOBES_MAX && work->surfaces->lobe_count > lobes;
    const int rest = LMP_KERNEL_LOBES_MAX - ZONAL_LOBES_MAX;
    const int kept = !more || bands <= LMP_BANDS_MAX / 2;
    vf(*const first)[LMP_BANDS_MAX] = work->weights;
    vf(*const second)[LMP_BANDS_MAX] = (void *)(work->weights[0] + (kept ? LMP_BANDS_MAX / 2 : 0));
    const size_t most = lobes == 1 ? ZONAL_LIGHTS_ONE : ZONAL_LIGHTS_MORE;
    for (size_t e = 0; e < work->count; e += LMP_LANES) {
        for (size_t i = 0; i < work->light_count; i += most) {
            const size_t left = work->light_count - i, taken = left < most ? left : most;
            if (i == 0 || !kept)
                zonal_weigh(0, lobes, bands, work, e, e > 0 && kept, first);
            if (!more) {
                shade_directions(lobes, work->surfaces, lights + i, taken, work->plain, e,
                                 work->directions, work->v);
                zonal_lobes(0, lobes, lobes, 1, bands, monic, work, (rows)first, i, taken, e);
                continue;
            }
            shade_directions(LMP_KERNEL_LOBES_MAX, work->surfaces, lights + i, taken, work->plain,
                             e, work->directions, work->v);
            zonal_lobes(0, lobes, LMP_KERNEL_LOBES_MAX, 1, bands, monic, work, (rows)first, i,
                        taken, e);
            if (i == 0 || !kept)
                zonal_weigh(lobes, rest, bands, work, e, e > 0 && kept, second);
            zonal_lobes(lobes, rest, LMP_KERNEL_LOBES_MAX, 0, bands, monic, work, (rows)second, i,
                        taken, e);
        }
    }
}

LMP_INLINE void zonal_surfaces(int bands, int constant, int lobes, const zonal_work *work) {
    if (constant || bands <= ZONAL_MONIC_BANDS)
        zonal_all(lobes, bands, 1, work);
    else
        zonal_all(lobes, bands, 0, work);
}

/* Under a sanitizer, which makes straight-line code of ten numbers of bands the work of minutes,
 * the code for any number does. */
#ifdef LMP_KERNELS_SANITIZED
#define ZONAL_SPECIALISE(bands, ...) zonal_surfaces(bands, 0, __VA_ARGS__);
#else
#define ZONAL_SPECIALISE(bands, ...) BASIS_SPECIALISE(bands, zonal_surfaces, __VA_ARGS__)
#endif

/* Surfaces of one lobe take less memory, and more lights. */
static LMP_NOINLINE void zonal_one(int bands, const zonal_work *call) {
    zonal_work work = *call;
    shade_direction directions[ZONAL_LIGHTS_ONE];
    vf v[ZONAL_LIGHTS_ONE], weights[1][LMP_BANDS_MAX];
    work.directions = directions;
    work.v = v;
    work.weights = weights;
    ZONAL_SPECIALISE(bands, 1, &work)
}

static LMP_NOINLINE void zonal_more(int bands, const zonal_work *call) {
    zonal_work work = *call;
    shade_direction directions[ZONAL_LIGHTS_MORE];
    vf v[ZONAL_LIGHTS_MORE * LMP_KERNEL_LOBES_MAX], weights[ZONAL_LOBES_MAX][LMP_BANDS_MAX];
    work.directions = directions;
    work.v = v;
    work.weights = weights;
    ZONAL_SPECIALISE(bands, ZONAL_LOBES_MAX, &work)
}

static void kernel_shade_zonal(int bands, const float *window, const float *diffuse,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *accumulated) {
    zonal_tables tables;
    const zonal_work work = { .tables = &tables,
                              .surfaces = surfaces,
                              .lights = lights,
                              .light_count = light_count,
                              .count = count,
                              .plain = shade_are_plain(lights, light_count),
                              .accumulated = accumulated };
    zonal_prepare(bands, bands <= ZONAL_MONIC_BANDS, window, diffuse, &tables);
    if (surfaces->lobe_count == 1)
        zonal_one(bands, &work);
    else
        zonal_more(bands, &work);
}

#endif
