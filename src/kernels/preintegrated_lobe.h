/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe.h - what the lobes of many surfaces reflect of many lights: of Phong lobes
 * read from a table of B-spline coefficients (lampion/preintegrated.h), of the diffuse one by its
 * closed form. Lanes are surfaces. */
#ifndef LAMPION_KERNELS_PREINTEGRATED_LOBE_H
#define LAMPION_KERNELS_PREINTEGRATED_LOBE_H

#include "src/kernels/products.h"
#include "src/kernels/shade.h"

#include "shaders/preintegrated_lookup.h"

#include <assert.h>

/* The cubic B-spline's weights of four neighbors, the point x past the second, times 6. */
LMP_INLINE void spline_weights(vf x, vf w[4]) {
    w[0] = lmp_lookup_outer(1 - x);
    w[1] = lmp_lookup_inner(x);
    w[2] = lmp_lookup_inner(1 - x);
    w[3] = lmp_lookup_outer(x);
}

/* Where the lobes of a block lie. */
typedef struct lobe_lanes {
    const int16_t *cell[LMP_LANES];
    size_t row[LMP_LANES]; /* coefficients from one to the next */
    vi row_pairs;
    vf fraction, density, angle;
} lobe_lanes;

/* What a light reads of them: weights of the pairs of four columns and of four rows. Element 4q + k
 * has its pairs' weights in quarter q of columns[k]; a lone one has pair k's there, which it reads
 * one by one and does not pack. */
typedef struct lobe_reading {
#if LMP_LANES > 1
    vf columns[4];
#else
    vi columns[4][2];
#endif
    vf rows[4];
    const int16_t *from[LMP_LANES];
} lobe_reading;

LMP_INLINE void lobe_locate(const lobe_lanes *lobe, vf g, vf a, lobe_reading *reading) {
    const vf x = g * lobe->density, y = a * lobe->density;
    const vi column = vi_from(x), row = vi_from(y), pair = row * lobe->row_pairs + column;
    vf across[4];
    spline_weights(x - vf_from(column), across);
    spline_weights(y - vf_from(row), reading->rows);
    const vf second = lobe->fraction * (SPLINE_ONE / 6),
             first = (1 - lobe->fraction) * (SPLINE_ONE / 6);
    for (int i = 0; i < 4; i++) {
        const vi low = vi_from(across[i] * first + 0.5f), high = vi_from(across[i] * second + 0.5f);
#if LMP_LANES > 1
        const vi both = low | high << 16;
        memcpy(&reading->columns[i], &both, sizeof both);
#else
        reading->columns[i][0] = low;
        reading->columns[i][1] = high;
#endif
    }
    int32_t pairs[LMP_LANES];
    memcpy(pairs, &pair, sizeof pairs);
    for (int e = 0; e < LMP_LANES; e++)
        reading->from[e] = lobe->cell[e] + 2 * (size_t)pairs[e];
#if LMP_LANES > 1
    layout_transpose4(reading->columns);
#endif
}

/* A row's columns and slices, weighted: integers, whose sum is exact. */
LMP_INLINE vi lobe_row_sum(const lobe_reading *reading, const int16_t *const *from) {
#if LMP_LANES > 1
    vf products[4];
    vi sums[4];
    LMP_UNROLL for (int k = 0; k < 4; k++) products[k] =
        pair_products(from + k, reading->columns[k]);
    layout_transpose4(products);
    memcpy(sums, products, sizeof sums);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
#else
    vi sum = 0;
    for (int j = 0; j < 4; j++)
        sum +=
            from[0][2 * j] * reading->columns[j][0] + from[0][2 * j + 1] * reading->columns[j][1];
    return sum;
#endif
}

/* The lobe's mean over a cap, times the two solid angles. */
LMP_INLINE vf lobe_read(const lobe_lanes *lobe, vf g, vf a) {
    lobe_reading reading;
    vf sum = vf_set(0);
    lobe_locate(lobe, g, a, &reading);
    LMP_UNROLL for (int i = 0; i < 4; i++) {
        sum = sum + reading.rows[i] * vf_from(lobe_row_sum(&reading, reading.from));
        for (int e = 0; e < LMP_LANES; e++)
            reading.from[e] += lobe->row[e];
    }
    return sum * (LMP_LOOKUP_COEFFICIENT_MAX / 32767.0f / 6 / SPLINE_ONE);
}

LMP_INLINE void lobe_lanes_load(const lmp_kernel_preintegrated_lobe *lobe,
                                const lmp_kernel_lobe_positions *positions, size_t e,
                                lobe_lanes *lanes) {
    for (size_t i = 0; i < LMP_LANES; i++) {
        lanes->cell[i] = lobe->pairs + 2 * (size_t)positions->first[e + i];
        lanes->row[i] = 2 * (size_t)positions->columns[e + i];
    }
    memcpy(&lanes->row_pairs, positions->columns + e, sizeof lanes->row_pairs);
    lanes->fraction = vf_load(positions->fraction + e);
    lanes->density = vf_load(positions->density + e);
    lanes->angle = vf_load(positions->lobe_angle + e);
}

/* A cap as the table is asked for it: its angle, the solid angle, 2 pi (1 - cos a), and the weight
 * of a response. A NaN becomes 0, which reads inside the table. */
typedef struct lobe_cap {
    vf angle, covered, weight;
} lobe_cap;

LMP_INLINE lobe_cap lobe_cap_of(const shade_direction *direction) {
    const vf t = vf_max(direction->t, vf_set(0));
    return (lobe_cap) { lmp_lookup_arc(t), 2 * LMP_KERNEL_PI * t,
                        2 * LMP_KERNEL_PI * direction->weight };
}

LMP_INLINE vf lobe_ambient(const shade_direction *direction, vf response) {
    return __builtin_expect(direction->is_ambient, 0) ? response + direction->ambient : response;
}

/* What a light gives a lobe, by the cosine v of its axis with the lobe's: the mean over the cap,
 * reading / (cap's + lobe's angle), times the cap's. */
LMP_INLINE vf lobe_alone(const lobe_lanes *lobe, const shade_direction *direction, vf v) {
    const lobe_cap cap = lobe_cap_of(direction);
    const vf read = lobe_read(lobe, lmp_lookup_acos(v), cap.angle);
    return lobe_ambient(direction, read * (cap.weight / (cap.covered + lobe->angle)));
}

/* Two lobes, with one division for both. */
LMP_INLINE void lobe_pair(const lobe_lanes lobes[2], const shade_direction *direction,
                          const vf v[2], vf responses[2]) {
    const lobe_cap cap = lobe_cap_of(direction);
    const vf one = lobe_read(&lobes[0], lmp_lookup_acos(v[0]), cap.angle);
    const vf other = lobe_read(&lobes[1], lmp_lookup_acos(v[1]), cap.angle);
    const vf first = cap.covered + lobes[0].angle, second = cap.covered + lobes[1].angle;
    const vf each = cap.weight / (first * second);
    responses[0] = lobe_ambient(direction, one * second * each);
    responses[1] = lobe_ambient(direction, other * first * each);
}

/* Where the lobes of a block of surfaces lie and point. */
typedef struct shade_block {
    vf point[3], normal[3], axis[LMP_KERNEL_LOBES_MAX][3];
} shade_block;

LMP_INLINE void shade_direction_of(int lobes, const lmp_packed_light *light, int plain,
                                   const shade_block *block, shade_direction *direction, vf *v) {
    const cap_lanes cap = shade_cap(light, plain, block->point, direction);
    direction->u = shade_dot(block->normal, &cap) * cap.per_d;
    LMP_UNROLL for (int k = 0; k < lobes; k++) v[k] = shade_dot(block->axis[k], &cap) * cap.per_d;
}

/* Some lights first, then their lobes: in one loop, the roots and quotients of a light would wait
 * for each other at its beginning. The v of a light follow those of the one before. */
LMP_INLINE void shade_directions(int lobes, const lmp_kernel_surfaces *surfaces,
                                 const lmp_packed_light *lights, size_t light_count, int plain,
                                 size_t e, shade_direction *directions, vf *v) {
    shade_block block;
    shade_planes(&surfaces->point, e, block.point);
    shade_planes(&surfaces->normal, e, block.normal);
    LMP_UNROLL for (int k = 0; k < lobes; k++)
        shade_planes(&surfaces->lobe[k].axis, e, block.axis[k]);
    for (size_t i = 0; i < light_count; i++)
        shade_direction_of(lobes, &lights[i], plain, &block, &directions[i], v + i * (size_t)lobes);
}

LMP_INLINE void lobe_shade_diffuse(const lmp_packed_light *lights, size_t light_count,
                                   const shade_direction *directions, size_t e,
                                   float *const planes[3]) {
    vf sums[3];
    shade_sums_load(planes, e, sums);
    for (size_t i = 0; i < light_count; i++) {
        const shade_direction *direction = &directions[i];
        const vf clipped = shade_clipped(direction->u, direction->t);
        const vf response = direction->weight * (vf_set(2) - direction->t) * clipped;
        shade_accumulate(&lights[i].color, lobe_ambient(direction, response), sums);
    }
    shade_sums_store(sums, e, planes);
}

/* A lobe of its own; v is that of the first light. */
LMP_INLINE void lobe_shade_alone(int lobe_count, const lobe_lanes *lobe,
                                 const lmp_packed_light *lights, size_t light_count,
                                 const shade_direction *directions, const vf *v, size_t e,
                                 float *const planes[3]) {
    vf sums[3];
    shade_sums_load(planes, e, sums);
    for (size_t i = 0; i < light_count; i++, v += lobe_count)
        shade_accumulate(&lights[i].color, lobe_alone(lobe, &directions[i], *v), sums);
    shade_sums_store(sums, e, planes);
}

LMP_INLINE void lobe_shade_pair(int lobe_count, const lobe_lanes lobes[2],
                                const lmp_packed_light *lights, size_t light_count,
                                const shade_direction *directions, const vf *v, size_t e,
                                float *const *const planes[2]) {
    vf sums[2][3], responses[2];
    shade_sums_load(planes[0], e, sums[0]);
    shade_sums_load(planes[1], e, sums[1]);
    for (size_t i = 0; i < light_count; i++, v += lobe_count) {
        lobe_pair(lobes, &directions[i], v, responses);
        shade_accumulate(&lights[i].color, responses[0], sums[0]);
        shade_accumulate(&lights[i].color, responses[1], sums[1]);
    }
    shade_sums_store(sums[0], e, planes[0]);
    shade_sums_store(sums[1], e, planes[1]);
}

/* Lights go by once for the diffuse lobe, once for the first of Phong's and once for each pair of
 * the others: more at once would not find registers. */
LMP_INLINE void lobe_shade(int lobe_count, const lmp_kernel_preintegrated_lobe *lobe,
                           const lmp_kernel_lobe_positions *specular,
                           const lmp_kernel_surfaces *surfaces, const lmp_packed_light *lights,
                           size_t light_count, size_t count,
                           const lmp_kernel_accumulated *accumulated) {
    const int plain = shade_are_plain(lights, light_count);
    shade_direction directions[LMP_KERNEL_LIGHTS_MAX];
    vf v[LMP_KERNEL_LIGHTS_MAX * LMP_KERNEL_LOBES_MAX];
    lobe_lanes lobes[2];
    for (size_t e = 0; e < count; e += LMP_LANES) {
        shade_directions(lobe_count, surfaces, lights, light_count, plain, e, directions, v);
        lobe_shade_diffuse(lights, light_count, directions, e, accumulated->diffuse);
        lobe_lanes_load(lobe, &specular[0], e, &lobes[0]);
        lobe_shade_alone(lobe_count, &lobes[0], lights, light_count, directions, v, e,
                         accumulated->specular[0]);
        for (int first = 1; first < lobe_count; first += 2) {
            float *const *const planes[2] = { accumulated->specular[first],
                                              accumulated->specular[first + 1] };
            lobe_lanes_load(lobe, &specular[first], e, &lobes[0]);
            lobe_lanes_load(lobe, &specular[first + 1], e, &lobes[1]);
            lobe_shade_pair(lobe_count, lobes, lights, light_count, directions, v + first, e,
                            planes);
        }
    }
}

static void kernel_shade_preintegrated_lobe(const lmp_kernel_preintegrated_lobe *lobe,
                                            const lmp_kernel_lobe_positions *specular,
                                            const lmp_kernel_surfaces *surfaces,
                                            const lmp_packed_light *lights, size_t light_count,
                                            size_t count,
                                            const lmp_kernel_accumulated *accumulated) {
    if (surfaces->lobe_count == 1)
        lobe_shade(1, lobe, specular, surfaces, lights, light_count, count, accumulated);
    else
        lobe_shade(surfaces->lobe_count, lobe, specular, surfaces, lights, light_count, count,
                   accumulated);
}

#endif
