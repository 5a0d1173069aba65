/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe.h - what the lobes of many surfaces reflect of many lights, read from a table
 * of B-spline coefficients (lampion/preintegrated.h): lanes are surfaces. */
#ifndef LAMPION_KERNELS_PREINTEGRATED_LOBE_H
#define LAMPION_KERNELS_PREINTEGRATED_LOBE_H

#include "src/kernels/angle.h"
#include "src/kernels/shade.h"

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
