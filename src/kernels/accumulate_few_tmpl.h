/* SPDX-License-Identifier: MIT */
/* accumulate_few_tmpl.h - many RGB lights into one point: lanes are lights, then orders m.
 *
 * A block of orders of a register of lights, C_m and S_m, then the values q_l^m R_l by bands, is
 * transposed to one row per light. A register of a row holds the same orders twice, for cosines and
 * for sines, so that one product with the light's colors and one sum serve both. Lights are added
 * in their order by the operations of accumulate_tmpl.h, which gives the same bits. */
#ifndef LAMPION_KERNELS_ACCUMULATE_FEW_TMPL_H
#define LAMPION_KERNELS_ACCUMULATE_FEW_TMPL_H

#include "src/kernels/accumulate_tmpl.h"

/* Orders of a block; the blocks of all orders; bands of a block that are summed at once; and
 * registers of lights that are begun side by side, because each waits for its roots and its
 * quotient. */
#define FEW_ORDERS  (LMPI_LANES / 2)
#define FEW_BLOCKS  ((FEW_BANDS + FEW_ORDERS - 1) / FEW_ORDERS)
#define FEW_AT_ONCE 3
#define FEW_AHEAD   4
#define FEW_SUMS    (FEW_BLOCKS * (FEW_BLOCKS + 1) / 2 * FEW_ORDERS)

/* Up to this many bands R_l are computed where lights are begun. More would fill the processor's
 * window before the next register is begun. */
#define FEW_AT_BEGIN 8

/* Up to this many bands straight-line code takes all blocks at once; and the number of those
 * blocks. */
#define FEW_STRAIGHT        10
#define FEW_STRAIGHT_BLOCKS ((FEW_STRAIGHT + FEW_ORDERS - 1) / FEW_ORDERS)
#define FEW_STRAIGHT_SUMS                                                                          \
    (FEW_STRAIGHT_BLOCKS * FEW_STRAIGHT -                                                          \
     FEW_STRAIGHT_BLOCKS * (FEW_STRAIGHT_BLOCKS - 1) / 2 * FEW_ORDERS)

/* Values of a light's row, for each block C_m, S_m and the bands, in whole registers: of the
 * largest block, or of all blocks. Then the values of a point, which reuse the memory of the
 * planes. */
#define FEW_ONE    (LMPI_LANES + FEW_BANDS * FEW_ORDERS)
#define FEW_ALL    (FEW_STRAIGHT_BLOCKS * LMPI_LANES + (FEW_STRAIGHT_SUMS + 1) * FEW_ORDERS)
#define FEW_ROW    ((FEW_ALL > FEW_ONE ? FEW_ALL : FEW_ONE) / LMPI_LANES * LMPI_LANES)
#define FEW_VALUES (3 * FEW_BANDS * FEW_BANDS)
#define FEW_PLANES (FEW_ROW * LMPI_LANES > FEW_VALUES ? FEW_ROW * LMPI_LANES : FEW_VALUES)

/* A register of lights: the start of their recurrences, and R_l. */
typedef struct few_lanes {
    accumulate_light light;
    vf rgb[3], radial[FEW_BANDS];
} few_lanes;

/* Planes of lights: centers, radii and radiances. */
typedef struct few_members {
    const float *at[7];
} few_members;

typedef struct few_work {
    few_lanes ahead[FEW_AHEAD];
    vf color[LMPI_LANES][3];
    vf sums[FEW_SUMS][3];
    const float *rgb;
    float LMPI_ALIGNED planes[FEW_PLANES];
    float LMPI_ALIGNED rows[LMPI_LANES * FEW_ROW];
    float LMPI_ALIGNED members[7][FEW_AHEAD * LMPI_LANES];
} few_work;

/* Returns element i, or the last one if that comes before. */
LMPI_INLINE float few_at(const float *array, size_t stride, size_t i, size_t last) {
    return lights_at(array, stride, i < last ? i : last);
}

/* Loads elements i, i + 1, … of an array that is not a plane. */
LMPI_INLINE vf few_load_apart(const float *array, size_t stride, size_t i, size_t live) {
    const size_t last = i + live - 1;
    vf4 quarters[(LMPI_LANES + 3) / 4];
    LMPI_UNROLL for (size_t q = 0; q < sizeof quarters / sizeof *quarters; q++, i += 4)
        quarters[q] =
            (vf4) { few_at(array, stride, i, last), few_at(array, stride, i + 1, last),
                    few_at(array, stride, i + 2, last), few_at(array, stride, i + 3, last) };
    return vf_join(quarters);
}

/* Loads `live` elements of a plane; lanes past the last element repeat it. */
LMPI_INLINE vf few_load(const float *plane, size_t live) {
    static const float LMPI_ALIGNED number[16] = { 0, 1, 2,  3,  4,  5,  6,  7,
                                                   8, 9, 10, 11, 12, 13, 14, 15 };
    /* by itself, because a register would wait for a plane's stores */
    if (live == 1)
        return vf_set(*plane);
    if (live == LMPI_LANES)
        return vf_load(plane);
    return vf_select_less(vf_load(number), vf_set((float)live), vf_load_first(plane, (int)live),
                          vf_set(plane[live - 1]));
}

/* Weakens lights i, i + 1, … by their visibility at a point, element `element` of the call. */
LMPI_INLINE void few_hide(const lmpi_kernel_lights *lights, size_t i, size_t live, size_t element,
                          cap_lanes *cap) {
    const size_t stride = lights->visibility_stride;
    const float *plane = lights->visibility + element;
    const vf visible = few_load_apart(plane, stride * sizeof *plane, i, live);
    cap->s2 = cap->s2 * visible;
    cap->t_full = cap->t_full * visible;
}

/* Returns the planes of the lights from light i on, which lie in planes. */
LMPI_INLINE few_members few_members_at(const lmpi_kernel_lights *lights, size_t i) {
    const lmp_vec3_array *center = &lights->center, *radiance = &lights->radiance;
    return (few_members) { { center->x + i, center->y + i, center->z + i, lights->radius.at + i,
                             radiance->x + i, radiance->y + i, radiance->z + i } };
}

/* Copies the lights from light i to `end`, which do not lie in planes, into planes. Written once
 * for all numbers of bands, because this is long code. */
static LMPI_NOINLINE few_members few_copy(const lmpi_kernel_lights *lights, size_t i, size_t end,
                                          float (*to)[FEW_AHEAD * LMPI_LANES]) {
    const lmp_vec3_array *center = &lights->center, *radiance = &lights->radiance;
    const size_t radius = lights->radius.stride;
    const size_t strides[7] = { center->stride,   center->stride,   center->stride,  radius,
                                radiance->stride, radiance->stride, radiance->stride };
    const few_members from = few_members_at(lights, 0);
    LMPI_ROLLED for (size_t k = 0; i + k < end; k += LMPI_LANES) {
        const size_t at = i + k, live = layout_live(end, at);
        LMPI_UNROLL for (int m = 0; m < 7; m++)
            vf_store(to[m] + k, few_load_apart(from.at[m], strides[m], at, live));
    }
    return (few_members) { { to[0], to[1], to[2], to[3], to[4], to[5], to[6] } };
}

/* Whether all members of lights lie in planes. */
LMPI_INLINE int few_are_planes(const lmpi_kernel_lights *lights) {
    const size_t plane = sizeof(float);
    return lights->center.stride == plane && lights->radius.stride == plane &&
           lights->radiance.stride == plane;
}

/* Computes R_l of all bands. */
LMPI_INLINE void few_radial(int bands, few_lanes *lanes) {
    const accumulate_tile all = { 0, bands, 0, bands };
    accumulate_radial(bands, all, 1, &lanes->light, lanes->radial);
}

/* Begins `live` lights at one point: those from light i on, element k of the planes. */
LMPI_INLINE void few_begin(int bands, const lmpi_kernel_lights *lights, const few_members *members,
                           size_t i, size_t k, size_t live, const lmpi_kernel_vec3 *points,
                           size_t element, few_lanes *lanes) {
    cap_lanes cap = cap_from(few_load(members->at[0] + k, live) - points->x[element],
                             few_load(members->at[1] + k, live) - points->y[element],
                             few_load(members->at[2] + k, live) - points->z[element],
                             few_load(members->at[3] + k, live), 0);
    if (__builtin_expect(lights->visibility != NULL, 0))
        few_hide(lights, i + k, live, element, &cap);
    lanes->radial[0] = accumulate_begin(cap, &lanes->light);
    if (bands <= FEW_AT_BEGIN)
        few_radial(bands, lanes);
    LMPI_UNROLL for (int c = 0; c < 3; c++) lanes->rgb[c] = few_load(members->at[4 + c] + k, live);
}

/* Returns the bands of all blocks that begin with orders below `first`: a block has the bands from
 * its first order on. */
LMPI_INLINE int few_bands(int bands, int first) {
    const int blocks = first / FEW_ORDERS;
    return blocks * bands - blocks * (blocks - 1) / 2 * FEW_ORDERS;
}

/* Returns the planes of all blocks that begin with orders below `first`. */
LMPI_INLINE int few_values(int bands, int first) {
    return first / FEW_ORDERS * LMPI_LANES + few_bands(bands, first) * FEW_ORDERS;
}

/* Clears the planes of a block that no light sets. */
LMPI_INLINE void few_clear(int bands, int first, float *planes) {
    LMPI_UNROLL for (int i = bands - first; i < FEW_ORDERS; i++) {
        vf_store(planes + i * LMPI_LANES, vf_set(0));
        vf_store(planes + (FEW_ORDERS + i) * LMPI_LANES, vf_set(0));
    }
    planes += LMPI_LANES * LMPI_LANES;
    const int rows = bands - first < FEW_ORDERS ? bands - first : FEW_ORDERS;
    LMPI_UNROLL for (int k = 0; k < rows; k++) LMPI_UNROLL for (int i = k + 1; i < FEW_ORDERS; i++)
        vf_store(planes + (k * FEW_ORDERS + i) * LMPI_LANES, vf_set(0));
}

/* Clears the planes that no light sets of the blocks before order `end`, and those that fill up a
 * multiple of LMPI_LANES. */
LMPI_INLINE void few_clear_all(int bands, int end, float *planes) {
    const int values = few_values(bands, end + FEW_ORDERS - 1);
    const int all = (values + LMPI_LANES - 1) / LMPI_LANES * LMPI_LANES;
    LMPI_UNROLL for (int first = 0; first < end; first += FEW_ORDERS)
        few_clear(bands, first, planes + few_values(bands, first) * LMPI_LANES);
    LMPI_UNROLL for (int v = values; v < all; v++) vf_store(planes + v * LMPI_LANES, vf_set(0));
}

/* Computes the orders of a block, from `first` on, for a register of lights: C_m and S_m in
 * FEW_ORDERS planes each, then as many planes for every band. */
LMPI_INLINE void few_planes(int bands, int first, int monic, const vf *radial,
                            accumulate_light *light, float *planes) {
    const int end = first + FEW_ORDERS < bands ? first + FEW_ORDERS : bands;
    accumulate_column column = { .z = { light->z } };
    LMPI_UNROLL for (int m = first; m < end; m++) {
        float *plane = planes + (m - first) * LMPI_LANES;
        if (m > 0)
            accumulate_rotate(m, light);
        vf_store(plane, light->c);
        vf_store(plane + FEW_ORDERS * LMPI_LANES, light->s);
        plane += LMPI_LANES * LMPI_LANES;
        accumulate_column_begin(m, monic, 1, &column);
        LMPI_UNROLL for (int l = m; l < bands; l++) {
            if (l > m)
                accumulate_step(lmpi_table_index(l, m), monic, 1, &column);
            vf_store(plane + (l - first) * FEW_ORDERS * LMPI_LANES, column.q1[0] * radial[l]);
        }
    }
}

/* Adds `live` lights to the sums of `count` bands of a block, whose rows begin at `azimuths`, those
 * of the bands at `rows`. Colors are computed once for all bands, and kept if more bands follow. */
LMPI_INLINE void few_sum(int count, int begins, int more, size_t live, few_work *work,
                         const float *azimuths, const float *rows, vf (*sums)[3]) {
    vf sum[FEW_AT_ONCE][3], color[3];
    LMPI_UNROLL for (int k = 0; k < count; k++) LMPI_UNROLL for (int c = 0; c < 3; c++) sum[k][c] =
        sums[k][c];
    LMPI_ROLLED for (size_t e = 0; e < live; e++) {
        if (begins) {
            const vf azimuth = vf_load(azimuths + e * FEW_ROW);
            LMPI_UNROLL for (int c = 0; c < 3; c++) color[c] =
                work->rgb[(size_t)c * LMPI_LANES + e] * azimuth;
        } else {
            LMPI_UNROLL for (int c = 0; c < 3; c++) color[c] = work->color[e][c];
        }
        if (begins && more)
            LMPI_UNROLL for (int c = 0; c < 3; c++) work->color[e][c] = color[c];
        LMPI_UNROLL for (int k = 0; k < count; k++) {
            const vf value = vf_load_twice(rows + e * FEW_ROW + k * FEW_ORDERS);
            LMPI_UNROLL for (int c = 0; c < 3; c++) sum[k][c] = sum[k][c] + color[c] * value;
        }
    }
    LMPI_UNROLL for (int k = 0; k < count; k++) LMPI_UNROLL for (int c = 0; c < 3; c++) sums[k][c] =
        sum[k][c];
}

/* Adds `live` lights to the sums of any number of bands of a block, as many at once as there are
 * registers for. */
LMPI_INLINE void few_add(int count, size_t live, few_work *work, const float *azimuths,
                         vf (*sums)[3]) {
    const float *rows = azimuths + LMPI_LANES;
    int k = 0;
    if (count > FEW_AT_ONCE) {
        few_sum(FEW_AT_ONCE, 1, 1, live, work, azimuths, rows, sums);
        for (k = FEW_AT_ONCE; k + FEW_AT_ONCE <= count; k += FEW_AT_ONCE)
            few_sum(FEW_AT_ONCE, 0, 0, live, work, azimuths, rows + k * FEW_ORDERS, sums + k);
    }
    LMPI_UNROLL for (int left = 1; left <= FEW_AT_ONCE; left++) if (count - k == left)
        few_sum(left, k == 0, 0, live, work, azimuths, rows + k * FEW_ORDERS, sums + k);
}

/* Adds a register of lights to the sums of the blocks that begin with orders begin … end-1: first
 * all planes, then all rows, then all sums, because each of these steps needs all registers. */
LMPI_INLINE void few_blocks(int bands, int begin, int end, size_t live, few_lanes *lanes,
                            few_work *work) {
    const int monic = bands <= LMPI_TABLE_MONIC_BANDS, before = few_values(bands, begin);
    const int values = few_values(bands, end + FEW_ORDERS - 1) - before;
    /* Kept in registers: loads of many lights in turn would wait for stores of others. */
    accumulate_light light = lanes->light;
    LMPI_UNROLL for (int first = begin; first < end; first += FEW_ORDERS)
        few_planes(bands, first, monic, lanes->radial, &light,
                   work->planes + (few_values(bands, first) - before) * LMPI_LANES);
    if (end < bands)
        lanes->light = light;
    LMPI_UNROLL for (int v = 0; v < values; v += LMPI_LANES)
        layout_square(work->planes + v * LMPI_LANES, work->rows + v, FEW_ROW);
    LMPI_UNROLL for (int first = begin; first < end; first += FEW_ORDERS)
        few_add(bands - first, live, work, work->rows + (few_values(bands, first) - before),
                work->sums + few_bands(bands, first));
}

/* Adds the lights from light i on, up to FEW_AHEAD registers of them. */
LMPI_INLINE void few_lights(int bands, int straight, const lmpi_kernel_lights *lights, size_t i,
                            const lmpi_kernel_vec3 *points, size_t element, few_work *work) {
    const size_t left = lights->count - i;
    const size_t end = left < FEW_AHEAD * LMPI_LANES ? left : FEW_AHEAD * LMPI_LANES;
    few_lanes *lanes = work->ahead;
    const few_members members = few_are_planes(lights)
                                    ? few_members_at(lights, i)
                                    : few_copy(lights, i, i + end, work->members);
    LMPI_ROLLED for (size_t k = 0; k < end; k += LMPI_LANES, lanes++)
        few_begin(bands, lights, &members, i, k, layout_live(end, k), points, element, lanes);
    lanes = work->ahead;
    LMPI_ROLLED for (size_t k = 0; bands > FEW_AT_BEGIN && k < end; k += LMPI_LANES)
        few_radial(bands, lanes++);
    lanes = work->ahead;
    LMPI_ROLLED for (size_t k = 0; k < end; k += LMPI_LANES, lanes++) {
        work->rgb = (const float *)(const void *)lanes->rgb;
        if (straight)
            few_blocks(bands, 0, bands, layout_live(end, k), lanes, work);
        else
            for (int first = 0; first < bands; first += FEW_ORDERS)
                few_blocks(bands, first, first + 1, layout_live(end, k), lanes, work);
    }
}

/* Returns the factor of (l, m) that is left to the end. */
LMPI_INLINE float few_norm(int bands, int l, int m) {
    return bands <= LMPI_TABLE_MONIC_BANDS ? lmpi_table_norm[lmpi_table_index(l, m)] : 1;
}

/* Writes the sums of band l for the orders from `first` on to both sides of the middle of its row,
 * in three planes of bands^2 values. */
LMPI_INLINE void few_put_band(int bands, int first, int l, const vf sums[3], float *middle) {
    const int plane = bands * bands;
#if LMPI_LANES == 8
    if (first + FEW_ORDERS <= l + 1) {
        const __m128 norm =
            _mm_setr_ps(few_norm(bands, l, first), few_norm(bands, l, first + 1),
                        few_norm(bands, l, first + 2), few_norm(bands, l, first + 3));
        LMPI_UNROLL for (int c = 0; c < 3; c++) {
            const __m128 cosines = _mm256_castps256_ps128((__m256)sums[c]);
            const __m128 sines = norm * _mm256_extractf128_ps((__m256)sums[c], 1);
            float *to = middle + c * plane;
            /* Stored before the cosines, which overwrite the sine of order 0. */
            _mm_storeu_ps(to - first - 3, _mm_shuffle_ps(sines, sines, _MM_SHUFFLE(0, 1, 2, 3)));
            _mm_storeu_ps(to + first, norm * cosines);
        }
        return;
    }
#endif
    const float *sum = (const float *)(const void *)sums;
    const int end = l + 1 < first + FEW_ORDERS ? l + 1 : first + FEW_ORDERS;
    LMPI_UNROLL for (int m = first; m < end; m++, sum++) {
        const float norm = few_norm(bands, l, m);
        LMPI_UNROLL for (int c = 0; c < 3; c++) {
            if (m > 0)
                middle[c * plane - m] = norm * sum[c * LMPI_LANES + FEW_ORDERS];
            middle[c * plane + m] = norm * sum[c * LMPI_LANES];
        }
    }
}

/* Writes a block that begins with order `first`. */
LMPI_INLINE void few_put(int bands, int first, vf (*sums)[3], float *row) {
    LMPI_UNROLL for (int l = first; l < bands; l++)
        few_put_band(bands, first, l, sums[l - first], row + l * l + l);
}

/* Computes the sums of the lights at one point, which is element `element` of the output. */
LMPI_INLINE void few_point(int bands, int straight, const lmpi_kernel_lights *lights,
                           const lmpi_kernel_vec3 *points, const lmpi_kernel_out *out,
                           size_t element, few_work *work) {
    const int count = few_bands(bands, bands + FEW_ORDERS - 1);
    for (int k = 0; k < count; k++)
        LMPI_UNROLL for (int c = 0; c < 3; c++) work->sums[k][c] = vf_set(0);
    few_clear_all(bands, straight ? bands : 1, work->planes);
    for (size_t i = 0; i < lights->count; i += FEW_AHEAD * LMPI_LANES)
        few_lights(bands, straight, lights, i, points, element, work);
    float *row = out->planar ? work->planes : out->at + element * out->stride;
    if (straight)
        LMPI_UNROLL for (int first = 0; first < bands; first += FEW_ORDERS)
            few_put(bands, first, work->sums + few_bands(bands, first), row);
    else
        for (int first = 0; first < bands; first += FEW_ORDERS)
            few_put(bands, first, work->sums + few_bands(bands, first), row);
    for (size_t v = 0; out->planar && v < (size_t)(3 * bands * bands); v++)
        out->at[v * out->stride + element] = row[v];
}

static LMPI_NOINLINE void accumulate_few(int bands, const lmpi_kernel_lights *lights,
                                         const lmpi_kernel_vec3 *points, const lmpi_kernel_out *out,
                                         size_t element) {
    few_work work;
    switch (bands) {
        LMPI_SMALL_CASES(few_point, 1, lights, points, out, element, &work)
    default:
        few_point(bands, 0, lights, points, out, element, &work);
    }
}

/* Sums lights at `live` points from `element` on, at most LMPI_LANES. */
static void accumulate_points(const lmp_scratch *scratch, int bands,
                              const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                              const lmpi_kernel_out *out, size_t element, size_t live) {
    if (!few_pays(bands, lights->count, live)) {
        accumulate_block(scratch, bands, lights, points, out, element, live);
        return;
    }
    for (size_t e = element; e < element + live; e++)
        accumulate_few(bands, lights, points, out, e);
}

#endif
