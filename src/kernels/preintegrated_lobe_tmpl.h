/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe_tmpl.h - what the lobes of many surfaces reflect of many lights: Phong lobes
 * are read from a table of B-spline coefficients (lampion/preintegrated.h), the diffuse lobe has
 * its closed form. Lanes are surfaces. */
#ifndef LAMPION_KERNELS_PREINTEGRATED_LOBE_TMPL_H
#define LAMPION_KERNELS_PREINTEGRATED_LOBE_TMPL_H

#include "src/kernels/products_tmpl.h"
#include "src/kernels/shade_tmpl.h"

#include "shaders/lampion/preintegrated_lookup.h"

#include <assert.h>

/* Computes the cubic B-spline's weights of four neighbors, for a point x past the second, times 6.
 */
LMPI_INLINE void spline_weights(vf x, vf w[4]) {
    w[0] = lmp_lookup_outer(1 - x);
    w[1] = lmp_lookup_inner(x);
    w[2] = lmp_lookup_inner(1 - x);
    w[3] = lmp_lookup_outer(x);
}

/* Where the lobes of a block lie in the table. */
typedef struct lobe_lanes {
    const int16_t *cell[LMPI_LANES];
    size_t row[LMPI_LANES]; /* coefficients from one row to the next */
    vi row_pairs;
    vf fraction, density, angle;
} lobe_lanes;

/* A reading of a block's lobes for one light: weights of the pairs of four columns, and of four
 * rows. */
typedef struct lobe_reading {
    pair_weights columns;
    vf rows[4];
    const int16_t *from[LMPI_LANES];
} lobe_reading;

LMPI_INLINE void lobe_locate(const lobe_lanes *lobe, vf g, vf a, lobe_reading *reading) {
    const vf x = g * lobe->density, y = a * lobe->density;
    const vi column = vi_from(x), row = vi_from(y), pair = row * lobe->row_pairs + column;
    vf across[4];
    spline_weights(x - vf_from(column), across);
    spline_weights(y - vf_from(row), reading->rows);
    const vf second = lobe->fraction * (SPLINE_ONE / 6),
             first = (1 - lobe->fraction) * (SPLINE_ONE / 6);
    vi low[4], high[4];
    for (int i = 0; i < 4; i++) {
        low[i] = vi_from(across[i] * first + 0.5f);
        high[i] = vi_from(across[i] * second + 0.5f);
    }
    pair_weights_of(low, high, &reading->columns);
    int32_t pairs[LMPI_LANES];
    memcpy(pairs, &pair, sizeof pairs);
    for (int e = 0; e < LMPI_LANES; e++)
        reading->from[e] = lobe->cell[e] + 2 * (size_t)pairs[e];
}

/* Returns the lobe's mean over a cap, times the two solid angles. */
LMPI_INLINE vf lobe_read(const lobe_lanes *lobe, vf g, vf a) {
    lobe_reading reading;
    vf sum = vf_set(0);
    lobe_locate(lobe, g, a, &reading);
    LMPI_UNROLL for (int i = 0; i < 4; i++) {
        sum = sum + reading.rows[i] * vf_from(pair_sum(&reading.columns, reading.from));
        for (int e = 0; e < LMPI_LANES; e++)
            reading.from[e] += lobe->row[e];
    }
    return sum * (LMP_LOOKUP_COEFFICIENT_MAX / 32767.0f / 6 / SPLINE_ONE);
}

LMPI_INLINE void lobe_lanes_load(const lmpi_kernel_preintegrated_lobe *lobe,
                                 const lmpi_kernel_lobe_positions *positions, size_t e,
                                 lobe_lanes *lanes) {
    for (size_t i = 0; i < LMPI_LANES; i++) {
        lanes->cell[i] = lobe->pairs + 2 * (size_t)positions->first[e + i];
        lanes->row[i] = 2 * (size_t)positions->columns[e + i];
    }
    memcpy(&lanes->row_pairs, positions->columns + e, sizeof lanes->row_pairs);
    lanes->fraction = vf_load(positions->fraction + e);
    lanes->density = vf_load(positions->density + e);
    lanes->angle = vf_load(positions->lobe_angle + e);
}

/* A cap as the table needs it: its angle, its solid angle 2 pi (1 - cos a), and the weight of a
 * response. NaN becomes 0, which reads inside the table. */
typedef struct lobe_cap {
    vf angle, covered, weight;
} lobe_cap;

LMPI_INLINE lobe_cap lobe_cap_of(const shade_direction *direction) {
    const vf t = vf_max(direction->t, vf_set(0));
    return (lobe_cap) { lmp_lookup_arc(t), 2 * LMPI_KERNEL_PI * t,
                        2 * LMPI_KERNEL_PI * direction->weight };
}

LMPI_INLINE vf lobe_ambient(const shade_direction *direction, vf response) {
    return __builtin_expect(direction->is_ambient, 0) ? response + direction->ambient : response;
}

/* Returns a lobe's response to a light, given the cosine v between their axes: the mean over the
 * cap, reading / (cap's + lobe's angle), times the cap's angle. */
LMPI_INLINE vf lobe_alone(const lobe_lanes *lobe, const shade_direction *direction, vf v) {
    const lobe_cap cap = lobe_cap_of(direction);
    const vf read = lobe_read(lobe, lmp_lookup_acos(v), cap.angle);
    return lobe_ambient(direction, read * (cap.weight / (cap.covered + lobe->angle)));
}

/* Computes the responses of two lobes, with one division for both. */
LMPI_INLINE void lobe_pair(const lobe_lanes lobes[2], const shade_direction *direction,
                           const vf v[2], vf responses[2]) {
    const lobe_cap cap = lobe_cap_of(direction);
    const vf one = lobe_read(&lobes[0], lmp_lookup_acos(v[0]), cap.angle);
    const vf other = lobe_read(&lobes[1], lmp_lookup_acos(v[1]), cap.angle);
    const vf first = cap.covered + lobes[0].angle, second = cap.covered + lobes[1].angle;
    const vf each = cap.weight / (first * second);
    responses[0] = lobe_ambient(direction, one * second * each);
    responses[1] = lobe_ambient(direction, other * first * each);
}

/* Where the surfaces of a block are, and the axes of their lobes. */
typedef struct shade_block {
    vf point[3], normal[3], axis[LMPI_KERNEL_LOBES_MAX][3];
} shade_block;

LMPI_INLINE void shade_direction_of(int lobes, const lmpi_packed_light *light, int plain,
                                    const shade_block *block, shade_direction *direction, vf *v) {
    const cap_lanes cap = shade_cap(light, plain, block->point, direction);
    direction->u = shade_dot(block->normal, &cap) * cap.per_d;
    LMPI_UNROLL for (int k = 0; k < lobes; k++) v[k] = shade_dot(block->axis[k], &cap) * cap.per_d;
}

/* Computes the directions of some lights before their lobes: in one loop, the roots and quotients
 * of a light would wait for each other at its beginning. The v of a light follow those of the light
 * before. */
LMPI_INLINE void shade_directions(int lobes, const lmpi_kernel_surfaces *surfaces,
                                  const lmpi_packed_light *lights, size_t light_count, int plain,
                                  size_t e, shade_direction *directions, vf *v) {
    shade_block block;
    shade_planes(&surfaces->point, e, block.point);
    shade_planes(&surfaces->normal, e, block.normal);
    LMPI_UNROLL for (int k = 0; k < lobes; k++)
        shade_planes(&surfaces->lobe[k].axis, e, block.axis[k]);
    for (size_t i = 0; i < light_count; i++)
        shade_direction_of(lobes, &lights[i], plain, &block, &directions[i], v + i * (size_t)lobes);
}

LMPI_INLINE void lobe_shade_diffuse(const lmpi_packed_light *lights, size_t light_count,
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

/* Adds the light that one lobe reflects; v points to that of the first light. */
LMPI_INLINE void lobe_shade_alone(int lobe_count, const lobe_lanes *lobe,
                                  const lmpi_packed_light *lights, size_t light_count,
                                  const shade_direction *directions, const vf *v, size_t e,
                                  float *const planes[3]) {
    vf sums[3];
    shade_sums_load(planes, e, sums);
    for (size_t i = 0; i < light_count; i++, v += lobe_count)
        shade_accumulate(&lights[i].color, lobe_alone(lobe, &directions[i], *v), sums);
    shade_sums_store(sums, e, planes);
}

LMPI_INLINE void lobe_shade_pair(int lobe_count, const lobe_lanes lobes[2],
                                 const lmpi_packed_light *lights, size_t light_count,
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

/* Loops over the lights once for the diffuse lobe, once for the first Phong lobe and once for each
 * pair of the others: more at once would run out of registers. */
LMPI_INLINE void lobe_shade(int lobe_count, const lmpi_kernel_preintegrated_lobe *lobe,
                            const lmpi_kernel_lobe_positions *specular,
                            const lmpi_kernel_surfaces *surfaces, const lmpi_packed_light *lights,
                            size_t light_count, size_t count,
                            const lmpi_kernel_accumulated *accumulated) {
    const int plain = shade_are_plain(lights, light_count);
    shade_direction directions[LMPI_KERNEL_LIGHTS_MAX];
    vf v[LMPI_KERNEL_LIGHTS_MAX * LMPI_KERNEL_LOBES_MAX];
    lobe_lanes lobes[2];
    for (size_t e = 0; e < count; e += LMPI_LANES) {
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

static void kernel_shade_preintegrated_lobe(const lmpi_kernel_preintegrated_lobe *lobe,
                                            const lmpi_kernel_lobe_positions *specular,
                                            const lmpi_kernel_surfaces *surfaces,
                                            const lmpi_packed_light *lights, size_t light_count,
                                            size_t count,
                                            const lmpi_kernel_accumulated *accumulated) {
    if (surfaces->lobe_count == 1)
        lobe_shade(1, lobe, specular, surfaces, lights, light_count, count, accumulated);
    else
        lobe_shade(surfaces->lobe_count, lobe, specular, surfaces, lights, light_count, count,
                   accumulated);
}

#endif
