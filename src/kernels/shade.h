/* SPDX-License-Identifier: MIT */
/* shade.h - what the lobes of many surfaces gather from many lights (shade.h of the API): lanes are
 * surfaces, each with its own normal, mirror direction and exponent; lights are broadcast.
 *
 * Of each light a surface needs two numbers: what the diffuse and the Phong lobe answer to its cap.
 * `zonal` sums bands; `response` reads them from a table of B-spline coefficients. */
#ifndef LAMPION_KERNELS_SHADE_H
#define LAMPION_KERNELS_SHADE_H

#include "src/kernels/accumulate.h"
#include "src/kernels/angle.h"

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

/* --- response --------------------------------------------------------------------------------- */

/* The integers of a reading: B-spline weights of four columns, two slices each, in units of
 * 1/SPLINE_ONE; products with the table's 16-bit values are summed exactly, so every build agrees.
 */
#define SPLINE_ONE 32767.0f

/* The cubic B-spline's weights of four neighbors, the point x past the second, times 6. */
LMP_INLINE void spline_weights(vf x, vf w[4]) {
    const vf y = 1 - x;
    w[0] = y * y * y;
    w[1] = 4 + 3 * (x * x) * (x - 2);
    w[2] = 4 + 3 * (y * y) * (y - 2);
    w[3] = x * x * x;
}

/* Where the lobes of a block lie. */
typedef struct response_lanes {
    const int16_t *cell[LMP_LANES];
    size_t row[LMP_LANES]; /* coefficients from one to the next */
    vi row_pairs;
    vf share, density, angle;
} response_lanes;

/* What a light reads of them: weights of the pairs of four columns and of four rows. Element 4q + k
 * has its pairs' weights in quarter q of columns[k]; a lone one has pair k's there. */
typedef struct response_reading {
    vf columns[4], rows[4];
    const int16_t *from[LMP_LANES];
} response_reading;

LMP_INLINE void response_aim(const response_lanes *lobe, vf g, vf a, response_reading *reading) {
    const vf x = g * lobe->density, y = a * lobe->density;
    const vi column = vi_from(x), row = vi_from(y), pair = row * lobe->row_pairs + column;
    vf across[4];
    spline_weights(x - vf_from(column), across);
    spline_weights(y - vf_from(row), reading->rows);
    const vf second = lobe->share * (SPLINE_ONE / 6), first = (1 - lobe->share) * (SPLINE_ONE / 6);
    for (int i = 0; i < 4; i++) {
        const vi low = vi_from(across[i] * first + 0.5f), high = vi_from(across[i] * second + 0.5f);
        const vi both = low | high << 16;
        memcpy(&reading->columns[i], &both, sizeof both);
    }
    int32_t pairs[LMP_LANES];
    memcpy(pairs, &pair, sizeof pairs);
    for (int e = 0; e < LMP_LANES; e++)
        reading->from[e] = lobe->cell[e] + 2 * (size_t)pairs[e];
#if LMP_LANES > 1
    layout_transpose4(reading->columns);
#endif
}

/* Of elements 0, 4, …: four sums of two products each, of a row's coefficients and their weights.
 */
#if LMP_LANES > 1 && defined(__SSE2__)
LMP_INLINE __m128i response_row(const int16_t *from) {
    return _mm_loadu_si128((const __m128i *)(const void *)from);
}
#endif
#if LMP_LANES == 4 && defined(__SSE2__)
LMP_INLINE vf response_products(const int16_t *const *from, vf columns) {
    return (vf)_mm_madd_epi16(response_row(from[0]), (__m128i)columns);
}
#elif LMP_LANES == 8
LMP_INLINE vf response_products(const int16_t *const *from, vf columns) {
    return (vf)_mm256_madd_epi16(_mm256_set_m128i(response_row(from[4]), response_row(from[0])),
                                 (__m256i)columns);
}
#elif LMP_LANES == 16
LMP_INLINE vf response_products(const int16_t *const *from, vf columns) {
    const __m256i low = _mm256_set_m128i(response_row(from[4]), response_row(from[0]));
    const __m256i high = _mm256_set_m128i(response_row(from[12]), response_row(from[8]));
    const __m256i first = _mm256_madd_epi16(low, _mm512_castsi512_si256((__m512i)columns));
    const __m256i second = _mm256_madd_epi16(high, _mm512_extracti64x4_epi64((__m512i)columns, 1));
    return (vf)_mm512_inserti64x4(_mm512_castsi256_si512(first), second, 1);
}
#elif LMP_LANES > 1
LMP_INLINE vf response_products(const int16_t *const *from, vf columns) {
    int16_t weights[2 * LMP_LANES];
    int32_t sums[LMP_LANES];
    memcpy(weights, &columns, sizeof weights);
    for (int i = 0; i < LMP_LANES; i++) {
        const int16_t *row = from[i / 4 * 4] + 2 * (i % 4);
        sums[i] = row[0] * weights[2 * i] + row[1] * weights[2 * i + 1];
    }
    vf products;
    memcpy(&products, sums, sizeof sums);
    return products;
}
#endif

/* A row's columns and slices, weighted: integers, whose sum is exact. */
LMP_INLINE vi response_row_sum(const response_reading *reading, const int16_t *const *from) {
#if LMP_LANES > 1
    vf products[4];
    vi sums[4];
    LMP_UNROLL for (int k = 0; k < 4; k++) products[k] =
        response_products(from + k, reading->columns[k]);
    layout_transpose4(products);
    memcpy(sums, products, sizeof sums);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
#else
    vi sum = 0;
    for (int j = 0; j < 4; j++) {
        int16_t weights[2];
        memcpy(weights, &reading->columns[j], sizeof weights);
        sum += from[0][2 * j] * weights[0] + from[0][2 * j + 1] * weights[1];
    }
    return sum;
#endif
}

/* The lobe's answer to a cap of strength R_0 = mean 1, times the two solid angles. */
LMP_INLINE vf response_read(const response_lanes *lobe, vf g, vf a) {
    response_reading reading;
    vf sum = vf_set(0);
    response_aim(lobe, g, a, &reading);
    LMP_UNROLL for (int i = 0; i < 4; i++) {
        sum = sum + reading.rows[i] * vf_from(response_row_sum(&reading, reading.from));
        for (int e = 0; e < LMP_LANES; e++)
            reading.from[e] += lobe->row[e];
    }
    return sum * (LMP_KERNEL_LOBE_UNIT / 6 / SPLINE_ONE);
}

/* acos(u), u in -1 … 1 but for rounding. */
LMP_INLINE vf shade_angle(vf u) {
    const vf zero = vf_set(0), beside = vf_max(u, -u), y = vf_max(1 - beside, zero);
    const vf across = vf_sqrt(y) * LMP_ANGLE(1 - y);
    return vf_select_less(u, zero, LMP_KERNEL_PI - across, across);
}

LMP_INLINE void response_lanes_load(const lmp_kernel_preintegrated_lobe *response,
                                    const lmp_kernel_lobe_positions *places, size_t e,
                                    response_lanes *lanes) {
    for (size_t i = 0; i < LMP_LANES; i++) {
        lanes->cell[i] = response->pairs + 2 * (size_t)places->first[e + i];
        lanes->row[i] = 2 * (size_t)places->columns[e + i];
    }
    memcpy(&lanes->row_pairs, places->columns + e, sizeof lanes->row_pairs);
    lanes->share = vf_load(places->share + e);
    lanes->density = vf_load(places->density + e);
    lanes->angle = vf_load(places->lobe_angle + e);
}

static void kernel_shade_response(const lmp_kernel_preintegrated_lobe *response,
                                  const lmp_kernel_lobe_positions *diffuse,
                                  const lmp_kernel_lobe_positions *specular,
                                  const lmp_kernel_surfaces *surfaces,
                                  const lmp_kernel_light *lights, size_t light_count, size_t count,
                                  const lmp_kernel_accumulated *gathered) {
    response_lanes broad, sharp;
    shade_aim aims[LMP_KERNEL_LIGHTS_MAX];
    response_lanes_load(response, diffuse, 0, &broad);
    for (size_t e = 0; e < count; e += LMP_LANES) {
        shade_sums sums;
        shade_sums_load(gathered, e, &sums);
        shade_aim_all(surfaces, lights, light_count, e, aims);
        response_lanes_load(response, specular, e, &sharp);
        for (size_t i = 0; i < light_count; i++) {
            /* A NaN becomes 0, which reads inside the table. */
            const vf t = vf_max(aims[i].t, vf_set(0)), a = vf_sqrt(t) * LMP_ANGLE(1 - t),
                     covered = 2 * LMP_KERNEL_PI * t;
            const vf d = response_read(&broad, shade_angle(aims[i].u), a);
            const vf s = response_read(&sharp, shade_angle(aims[i].v), a);
            /* One division for both: mean over the cap = reading / (cap's + lobe's angle). */
            const vf wide = covered + broad.angle, narrow = covered + sharp.angle;
            const vf each = 2 * LMP_KERNEL_PI * aims[i].weight / (wide * narrow);
            vf broad_sum = d * narrow * each, sharp_sum = s * wide * each;
            if (__builtin_expect(aims[i].everywhere, 0)) {
                broad_sum = broad_sum + aims[i].ambient;
                sharp_sum = sharp_sum + aims[i].ambient;
            }
            shade_gather(lights[i].radiance, broad_sum, sharp_sum, &sums);
        }
        shade_sums_store(&sums, e, gathered);
    }
}

#endif
