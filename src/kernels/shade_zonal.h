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

/* P_l = t_l u P_(l-1) - d_l P_(l-2), or in monic form t = 1. */
LMP_INLINE double zonal_t(int monic, int l) {
    return monic ? 1 : (2 * l - 1) / (double)l;
}
LMP_INLINE double zonal_d(int monic, int l) {
    return monic ? (l - 1) * (l - 1) / (double)((2 * l - 1) * (2 * l - 3)) : (l - 1) / (double)l;
}

/* Two steps of P_l at once, l even. */
static inline void zonal_prepare_even(int l, int monic, zonal_tables *tables) {
    const double t2 = zonal_t(monic, l), t1 = zonal_t(monic, l - 1);
    const double d2 = zonal_d(monic, l), d1 = zonal_d(monic, l - 1);
    const double down = l == 2 ? 0 : t2 * d1 / zonal_t(monic, l - 2);
    tables->even_a[l / 2] = zonal_number_of((float)(t2 * t1));
    tables->even_b[l / 2] = zonal_number_of((float)(down + d2));
    tables->even_c[l / 2] = zonal_number_of(l == 2 ? 0.f : (float)(down * zonal_d(monic, l - 2)));
}

static inline void zonal_prepare(int bands, int monic, const float *window, const float *diffuse,
                                 zonal_tables *tables) {
    double norm_p = 1, norm_r = 1;
    for (int l = 0; l < bands || l < ZONAL_BANDS_MIN; l++) {
        if (monic && l >= 1)
            norm_p *= (2 * l - 1) / (double)l;
        if (monic && l >= 2) {
            /* R_l = (2l-1)/(l+1) alpha R_(l-1) - (l-2)/(l+1) R_(l-2) */
            norm_r *= (2 * l - 1) / (double)(l + 1);
            tables->cap[l] =
                zonal_number_of((float)((l - 2) * l / (double)((2 * l - 1) * (2 * l - 3))));
            tables->lobe[l] = zonal_number_of((float)zonal_d(monic, l));
        }
        const double scale = (l == 0 ? 0.5 : (2 * l + 1) / 4.0) * norm_p * norm_r;
        const double factor = l < bands ? scale * (double)window[l] : 0;
        tables->phong[l] = zonal_number_of((float)factor);
        const float of_diffuse = l < bands ? (float)(factor * (double)diffuse[l]) : 0;
        if (l % 2 == 0)
            tables->diffuse[l / 2] = zonal_number_of(of_diffuse);
        else if (l == 1)
            tables->diffuse_1 = zonal_number_of(of_diffuse);
        if (l >= 2 && l % 2 == 0)
            zonal_prepare_even(l, monic, tables);
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

/* Of R_l P_l of each Phong lobe, by band. */
typedef struct zonal_weights {
    vf of[LMP_KERNEL_LOBES_MAX][LMP_BANDS_MAX];
} zonal_weights;

/* The lobes' sums on their way through the bands: R_l, P_l of the normal (even l) and of each axis,
 * each with the one before. */
typedef struct zonal_sums {
    vf r1, r0, p1, p0, q1[LMP_KERNEL_LOBES_MAX], q0[LMP_KERNEL_LOBES_MAX];
    vf diffuse, specular[LMP_KERNEL_LOBES_MAX];
} zonal_sums;

LMP_INLINE void zonal_add_specular(int lobes, const zonal_weights *weights, int l,
                                   zonal_sums *sums) {
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums->specular[k] = sums->specular[k] + weights->of[k][l] * (sums->r1 * sums->q1[k]);
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

LMP_INLINE zonal_sums zonal_monic(int lobes, int bands, const zonal_tables *tables,
                                  const zonal_weights *weights, const shade_direction *direction) {
    const vf one = vf_set(1), square = direction->u * direction->u, x = one - direction->t;
    zonal_sums sums = { .r1 = x,
                        .r0 = one,
                        .p1 = square - tables->even_b[1],
                        .p0 = one,
                        .diffuse = tables->diffuse_1 * direction->u };
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums.q1[k] = direction->v[k] * direction->v[k] - tables->lobe[2];
        sums.q0[k] = direction->v[k];
        sums.specular[k] = weights->of[k][1] * direction->v[k];
    }
    sums.diffuse = sums.diffuse + tables->diffuse[1] * (x * sums.p1);
    zonal_add_specular(lobes, weights, 2, &sums);
    LMP_UNROLL for (int l = 3; l < bands; l += 2) {
        zonal_step(lobes, tables, l, x, direction->v, &sums);
        zonal_add_specular(lobes, weights, l, &sums);
        if (l + 1 == bands)
            break;
        zonal_step(lobes, tables, l + 1, x, direction->v, &sums);
        zonal_add_specular(lobes, weights, l + 1, &sums);
        zonal_add_diffuse(tables, l + 1, square, &sums);
    }
    return sums;
}

/* The same of more bands: R_l by its differences r0 = R_l - R_(l-1), which keeps more of them
 * exact. */
LMP_INLINE zonal_sums zonal_long(int lobes, int bands, const zonal_tables *tables,
                                 const zonal_weights *weights, const shade_direction *direction) {
    const vf one = vf_set(1), zero = vf_set(0), square = direction->u * direction->u;
    zonal_sums sums = { one, zero, one, zero, .diffuse = tables->diffuse_1 * direction->u };
    LMP_UNROLL for (int k = 0; k < lobes; k++) {
        sums.q1[k] = direction->v[k];
        sums.q0[k] = one;
        sums.specular[k] = weights->of[k][1] * direction->v[k];
    }
    LMP_ROLLED for (int l = 2; l < bands; l++) {
        const float *d = lmp_table_legendre_d, *t = lmp_table_legendre_t;
        sums.r0 = lmp_table_cap_d[l] * sums.r0 - lmp_table_cap_t[l] * (direction->t * sums.r1);
        sums.r1 = sums.r1 + sums.r0;
        LMP_UNROLL for (int k = 0; k < lobes; k++) {
            const vf q2 = t[l] * (direction->v[k] * sums.q1[k]) - d[l] * sums.q0[k];
            sums.q0[k] = sums.q1[k];
            sums.q1[k] = q2;
        }
        zonal_add_specular(lobes, weights, l, &sums);
        if (l % 2 == 0)
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

/* Adds one light's responses to the block's sums. The chains of successive lights run side by side:
 * none waits for the one before. */
LMP_INLINE void zonal_light(int lobes, int bands, int monic, const zonal_tables *tables,
                            const zonal_weights *weights, const shade_direction *direction,
                            lmp_rgb rgb, shade_sums *sums) {
    const zonal_sums zonal = monic ? zonal_monic(lobes, bands, tables, weights, direction)
                                   : zonal_long(lobes, bands, tables, weights, direction);
    shade_accumulate(rgb, zonal_response(direction, zonal.diffuse, zonal_lanes(tables->diffuse[0])),
                     sums->diffuse);
    LMP_UNROLL for (int k = 0; k < lobes; k++) shade_accumulate(
        rgb, zonal_response(direction, zonal.specular[k], weights->of[k][0]), sums->specular[k]);
}

LMP_INLINE void zonal_all(int lobes, int bands, int monic, const zonal_tables *tables,
                          const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                          size_t light_count, size_t count,
                          const lmp_kernel_accumulated *accumulated) {
    shade_direction directions[LMP_KERNEL_LIGHTS_MAX];
    zonal_weights weights;
    for (size_t e = 0; e < count; e += LMP_LANES) {
        shade_sums sums;
        shade_sums_load(lobes, accumulated, e, &sums);
        for (int k = 0; k < lobes; k++) {
            const float *exponent = surfaces->lobe[k].exponent + e;
            /* Neighbors are often of one material. */
            if (e == 0 || memcmp(exponent, exponent - LMP_LANES, sizeof(vf)) != 0)
                zonal_phong(bands, tables, vf_load(exponent), weights.of[k]);
        }
        shade_directions(lobes, surfaces, lights, light_count, e, directions);
        for (size_t i = 0; i < light_count; i++) {
            LMP_OPAQUE(tables);
            zonal_light(lobes, bands, monic, tables, &weights, &directions[i], lights[i].radiance,
                        &sums);
        }
        shade_sums_store(lobes, &sums, e, accumulated);
    }
}

LMP_INLINE void zonal_surfaces(int bands, int constant, int lobes, const zonal_tables *tables,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *accumulated) {
    if (constant || bands <= ZONAL_MONIC_BANDS)
        zonal_all(lobes, bands, 1, tables, surfaces, lights, light_count, count, accumulated);
    else
        zonal_all(lobes, bands, 0, tables, surfaces, lights, light_count, count, accumulated);
}

static void kernel_shade_zonal(int bands, const float *window, const float *diffuse,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *accumulated) {
    zonal_tables tables;
    zonal_prepare(bands, bands <= ZONAL_MONIC_BANDS, window, diffuse, &tables);
    if (surfaces->lobe_count == 1) {
        BASIS_SPECIALISE(bands, zonal_surfaces, 1, &tables, surfaces, lights, light_count, count,
                         accumulated)
    } else {
        BASIS_SPECIALISE(bands, zonal_surfaces, LMP_KERNEL_LOBES_MAX, &tables, surfaces, lights,
                         light_count, count, accumulated)
    }
}

#endif
