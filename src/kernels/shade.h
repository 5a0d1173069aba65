/* SPDX-License-Identifier: MIT */
/* shade.h - what the lobes of many surfaces gather from many lights (shade.h of the API): lanes are
 * surfaces, each with its own normal, mirror direction and exponent; lights are broadcast.
 *
 * Of each light a surface needs two numbers: what the diffuse and the Phong lobe answer to its cap.
 * `zonal` sums bands; preintegrated_lobe.h reads them from a table. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"

/* --- lights ----------------------------------------------------------------------------------- */

/* What the lobes of a block of surfaces are and see. */
typedef struct shade_block {
    vf point[3], normal[3], mirror[3];
} shade_block;

/* What of a light they need: of its cap of at most a hemisphere u and v, the cosines of its axis
 * with normal and mirror direction, and t; the weight of its answers, t but for the light's scale
 * and sign. With `everywhere`, light from all around besides (lmp_cap). */
typedef struct shade_aim {
    vf u, v, t, weight;
    vf ambient; /* set if everywhere */
    int everywhere;
} shade_aim;

/* Sets all but u and v. Of the cap, x, y, z times per_d are its axis. */
LMP_INLINE cap_lanes shade_cap(const lmp_kernel_light *light, size_t e, const vf point[3],
                               shade_aim *aim) {
    vf x = vf_set(light->x), y = vf_set(light->y), z = vf_set(light->z);
    if (light->w > 0) {
        x = x - point[0];
        y = y - point[1];
        z = z - point[2];
    }
    cap_lanes cap = cap_from(x, y, z, vf_set(light->radius), 0);
    vf weight = cap.t;
    if (__builtin_expect(cap.inside, 0)) {
        /* even is -1 inside: the complementary cap is taken away from light all around. */
        cap.per_d = cap.per_d * cap.even;
        weight = weight * cap.even;
        aim->ambient = (vf_set(1) - cap.even) * 0.5f;
    }
    if (__builtin_expect(light->scale != NULL, 0)) {
        const vf scale = vf_load(light->scale + e);
        weight = weight * scale;
        if (cap.inside)
            aim->ambient = aim->ambient * scale;
    }
    aim->everywhere = cap.inside;
    aim->t = cap.t;
    aim->weight = weight;
    return cap;
}

LMP_INLINE vf shade_dot(const vf a[3], const cap_lanes *cap) {
    return a[0] * cap->x + a[1] * cap->y + a[2] * cap->z;
}

LMP_INLINE void shade_aim_at(const lmp_kernel_light *light, size_t e, const shade_block *block,
                             shade_aim *aim) {
    const cap_lanes cap = shade_cap(light, e, block->point, aim);
    aim->u = shade_dot(block->normal, &cap) * cap.per_d;
    aim->v = shade_dot(block->mirror, &cap) * cap.per_d;
}

/* What both lobes of a block of surfaces have gathered: red, green, blue. */
typedef struct shade_sums {
    vf diffuse[3], specular[3];
} shade_sums;

LMP_INLINE void shade_gather(lmp_rgb rgb, vf diffuse, vf specular, shade_sums *sums) {
    sums->diffuse[0] = sums->diffuse[0] + rgb.r * diffuse;
    sums->diffuse[1] = sums->diffuse[1] + rgb.g * diffuse;
    sums->diffuse[2] = sums->diffuse[2] + rgb.b * diffuse;
    sums->specular[0] = sums->specular[0] + rgb.r * specular;
    sums->specular[1] = sums->specular[1] + rgb.g * specular;
    sums->specular[2] = sums->specular[2] + rgb.b * specular;
}

LMP_INLINE void shade_planes(const lmp_kernel_vec3 *planes, size_t e, vf to[3]) {
    to[0] = vf_load(planes->x + e);
    to[1] = vf_load(planes->y + e);
    to[2] = vf_load(planes->z + e);
}

LMP_INLINE void shade_sums_load(const lmp_kernel_accumulated *gathered, size_t e,
                                shade_sums *sums) {
    for (int c = 0; c < 3; c++) {
        sums->diffuse[c] = vf_load(gathered->diffuse[c] + e);
        sums->specular[c] = vf_load(gathered->specular[c] + e);
    }
}

LMP_INLINE void shade_sums_store(const shade_sums *sums, size_t e,
                                 const lmp_kernel_accumulated *gathered) {
    for (int c = 0; c < 3; c++) {
        vf_store(gathered->diffuse[c] + e, sums->diffuse[c]);
        vf_store(gathered->specular[c] + e, sums->specular[c]);
    }
}

/* All lights first, then their lobes: in one loop, the roots and quotients of a light would wait
 * for each other at its beginning. */
LMP_INLINE void shade_aim_all(const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                              size_t light_count, size_t e, shade_aim *aims) {
    shade_block block;
    const vf *normal = block.normal;
    vf *mirror = block.mirror;
    shade_planes(&surfaces->point, e, block.point);
    shade_planes(&surfaces->normal, e, block.normal);
    shade_planes(&surfaces->view, e, mirror);
    const vf twice = 2 * (normal[0] * mirror[0] + normal[1] * mirror[1] + normal[2] * mirror[2]);
    for (int i = 0; i < 3; i++)
        mirror[i] = twice * normal[i] - mirror[i];
    for (size_t i = 0; i < light_count; i++)
        shade_aim_at(&lights[i], e, &block, &aims[i]);
}

/* --- zonal ------------------------------------------------------------------------------------ */

/* Up to so many bands all recurrences run in monic form, x p_(l-1) - c_l p_(l-2): the product of
 * two monic polynomials then stays a normal float. */
#define ZONAL_MONIC_BANDS 48

/* What is the same for every surface, by band, broadcast: as operands in memory they cost no
 * instruction. The factors of R_l P_l hold their norms, of l = 0 those of strength and solid angle,
 * which are pi (1 + |cos a|) and 2 pi times an aim's weight.
 * Even bands of the diffuse lobe take two steps at once:
 * P_l = (even_a u² - even_b) P_(l-2) - even_c P_(l-4), even_a = 1 in monic form. */
typedef struct zonal_tables {
    vf diffuse[LMP_BANDS_MAX], phong[LMP_BANDS_MAX];
    vf cap[LMP_BANDS_MAX], lobe[LMP_BANDS_MAX]; /* c_l; only in monic form */
    vf even_a[LMP_BANDS_MAX], even_b[LMP_BANDS_MAX], even_c[LMP_BANDS_MAX];
} zonal_tables;

/* Fewer bands are padded by some of weight 0. */
#define ZONAL_BANDS_MIN 3

/* P_l = t_l u P_(l-1) - d_l P_(l-2), or in monic form t = 1. */
LMP_INLINE double zonal_t(int monic, int l) {
    return monic ? 1 : (2 * l - 1) / (double)l;
}
LMP_INLINE double zonal_d(int monic, int l) {
    return monic ? (l - 1) * (l - 1) / (double)((2 * l - 1) * (2 * l - 3)) : (l - 1) / (double)l;
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
            tables->cap[l] = vf_set((float)((l - 2) * l / (double)((2 * l - 1) * (2 * l - 3))));
            tables->lobe[l] = vf_set((float)zonal_d(monic, l));
        }
        const double scale = (l == 0 ? 0.5 : (2 * l + 1) / 4.0) * norm_p * norm_r;
        const double factor = l < bands ? scale * (double)window[l] : 0;
        tables->phong[l] = vf_set((float)factor);
        tables->diffuse[l] = vf_set(l < bands ? (float)(factor * (double)diffuse[l]) : 0);
        if (l >= 2) {
            const double t2 = zonal_t(monic, l), t1 = zonal_t(monic, l - 1);
            const double d2 = zonal_d(monic, l), d1 = zonal_d(monic, l - 1);
            const double down = l == 2 ? 0 : t2 * d1 / zonal_t(monic, l - 2);
            tables->even_a[l] = vf_set((float)(t2 * t1));
            tables->even_b[l] = vf_set((float)(down + d2));
            tables->even_c[l] = vf_set(l == 2 ? 0.f : (float)(down * zonal_d(monic, l - 2)));
        }
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

/* Both lobes' sums on their way through the bands: R_l, P_l of the normal (even l) and of the
 * mirror direction, each with the one before. */
typedef struct zonal_sums {
    vf r1, r0, p1, p0, q1, q0;
    vf diffuse, specular;
} zonal_sums;

LMP_INLINE void zonal_add_specular(const vf *weights, int l, zonal_sums *sums) {
    sums->specular = sums->specular + weights[l] * (sums->r1 * sums->q1);
    LMP_OPAQUE_LANES(sums->specular);
}

LMP_INLINE void zonal_add_diffuse(const zonal_tables *tables, int l, vf square, zonal_sums *sums) {
    const vf p2 = (square - tables->even_b[l]) * sums->p1 - tables->even_c[l] * sums->p0;
    sums->p0 = sums->p1;
    sums->p1 = p2;
    sums->diffuse = sums->diffuse + tables->diffuse[l] * (sums->r1 * p2);
    LMP_OPAQUE_LANES(sums->diffuse);
}

/* Monic form, x = |cos a|. */
LMP_INLINE void zonal_step(const zonal_tables *tables, int l, vf x, vf v, zonal_sums *sums) {
    const vf r2 = x * sums->r1 - tables->cap[l] * sums->r0;
    const vf q2 = v * sums->q1 - tables->lobe[l] * sums->q0;
    sums->r0 = sums->r1;
    sums->r1 = r2;
    sums->q0 = sums->q1;
    sums->q1 = q2;
}

LMP_INLINE zonal_sums zonal_monic(int bands, const zonal_tables *tables, const vf *weights,
                                  const shade_aim *aim) {
    const vf one = vf_set(1), v = aim->v, square = aim->u * aim->u, x = one - aim->t;
    zonal_sums sums = { x,
                        one,
                        square - tables->even_b[2],
                        one,
                        v * v - tables->lobe[2],
                        v,
                        tables->diffuse[1] * aim->u,
                        weights[1] * v };
    sums.diffuse = sums.diffuse + tables->diffuse[2] * (x * sums.p1);
    zonal_add_specular(weights, 2, &sums);
    LMP_UNROLL for (int l = 3; l < bands; l += 2) {
        zonal_step(tables, l, x, v, &sums);
        zonal_add_specular(weights, l, &sums);
        if (l + 1 == bands)
            break;
        zonal_step(tables, l + 1, x, v, &sums);
        zonal_add_specular(weights, l + 1, &sums);
        zonal_add_diffuse(tables, l + 1, square, &sums);
    }
    return sums;
}

/* The same of more bands: R_l by its differences r0 = R_l - R_(l-1), which keeps more of them
 * exact. */
LMP_INLINE zonal_sums zonal_long(int bands, const zonal_tables *tables, const vf *weights,
                                 const shade_aim *aim) {
    const vf one = vf_set(1), zero = vf_set(0), v = aim->v, square = aim->u * aim->u;
    zonal_sums sums = { one, zero, one, zero, v, one, tables->diffuse[1] * aim->u, weights[1] * v };
    LMP_ROLLED for (int l = 2; l < bands; l++) {
        const float *d = lmp_table_legendre_d, *t = lmp_table_legendre_t;
        sums.r0 = lmp_table_cap_d[l] * sums.r0 - lmp_table_cap_t[l] * (aim->t * sums.r1);
        sums.r1 = sums.r1 + sums.r0;
        const vf q2 = t[l] * (v * sums.q1) - d[l] * sums.q0;
        sums.q0 = sums.q1;
        sums.q1 = q2;
        zonal_add_specular(weights, l, &sums);
        if (l % 2 == 0)
            zonal_add_diffuse(tables, l, tables->even_a[l] * square, &sums);
    }
    return sums;
}

/* Adds one light's answers to the block's sums. The chains of successive lights run side by side:
 * none waits for the one before. */
LMP_INLINE void zonal_light(int bands, int monic, const zonal_tables *tables, const vf *weights,
                            const shade_aim *aim, lmp_rgb rgb, shade_sums *sums) {
    const zonal_sums zonal =
        monic ? zonal_monic(bands, tables, weights, aim) : zonal_long(bands, tables, weights, aim);
    const vf rise = vf_set(2) - aim->t;
    vf diffuse = aim->weight * (rise * zonal.diffuse + tables->diffuse[0]);
    vf specular = aim->weight * (rise * zonal.specular + weights[0]);
    if (__builtin_expect(aim->everywhere, 0)) {
        diffuse = diffuse + 2 * tables->diffuse[0] * aim->ambient;
        specular = specular + 2 * weights[0] * aim->ambient;
    }
    shade_gather(rgb, diffuse, specular, sums);
}

LMP_INLINE void zonal_all(int bands, int monic, const zonal_tables *tables,
                          const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                          size_t light_count, size_t count,
                          const lmp_kernel_accumulated *gathered) {
    shade_aim aims[LMP_KERNEL_LIGHTS_MAX];
    vf weights[LMP_BANDS_MAX]; /* of R_l P_l of the Phong lobe */
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const float *exponent = surfaces->exponent + e;
        shade_sums sums;
        shade_sums_load(gathered, e, &sums);
        /* Neighbors are often of one material. */
        if (e == 0 || memcmp(exponent, exponent - LMP_LANES, sizeof(vf)) != 0)
            zonal_phong(bands, tables, vf_load(exponent), weights);
        shade_aim_all(surfaces, lights, light_count, e, aims);
        for (size_t i = 0; i < light_count; i++) {
            LMP_OPAQUE(tables);
            zonal_light(bands, monic, tables, weights, &aims[i], lights[i].radiance, &sums);
        }
        shade_sums_store(&sums, e, gathered);
    }
}

LMP_INLINE void zonal_surfaces(int bands, int constant, const zonal_tables *tables,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *gathered) {
    if (constant || bands <= ZONAL_MONIC_BANDS)
        zonal_all(bands, 1, tables, surfaces, lights, light_count, count, gathered);
    else
        zonal_all(bands, 0, tables, surfaces, lights, light_count, count, gathered);
}

static void kernel_shade_zonal(int bands, const float *window, const float *diffuse,
                               const lmp_kernel_surfaces *surfaces, const lmp_kernel_light *lights,
                               size_t light_count, size_t count,
                               const lmp_kernel_accumulated *gathered) {
    zonal_tables tables;
    zonal_prepare(bands, bands <= ZONAL_MONIC_BANDS, window, diffuse, &tables);
    BASIS_SPECIALISE(bands, zonal_surfaces, &tables, surfaces, lights, light_count, count, gathered)
}

#endif
