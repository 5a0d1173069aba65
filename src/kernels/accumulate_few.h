/* SPDX-License-Identifier: MIT */
/* accumulate_few.h - many RGB lights into one point: lanes are lights, then orders m.
 *
 * What a register of lights has of a block of orders, C_m and S_m, then the values q_l^m R_l by
 * bands, is transposed to a row a light. A register of a row is the same orders twice, for cosines
 * and for sines, so that one product with the light's colors and one sum serve both. Lights are
 * added in their order by the operations of accumulate.h: the same bits. */
#ifndef LAMPION_KERNELS_ACCUMULATE_FEW_H
#define LAMPION_KERNELS_ACCUMULATE_FEW_H

#include "src/kernels/accumulate.h"

/* Points that are few, as measured (16 lanes leave them to AVX2), and the bands whose sums fit the
 * stack. */
#define FEW_POINTS(bands)                                                                          \
    (LMP_LANES == 1                ? 0                                                             \
     : LMP_LANES == 4              ? (bands) <= 10 ? 2 : 1                                         \
     : (bands) < 5 || (bands) > 10 ? 4                                                             \
                                   : 5)
#define FEW_BANDS 32

/* Whether `live` points cost less one by one, as measured: a block of them costs as much as one. */
LMP_INLINE int few_pays(int bands, size_t lights, size_t live) {
    return bands <= FEW_BANDS && live <= FEW_POINTS(bands) && 4 * live <= lights + 8;
}

#if LMP_LANES == 4 || LMP_LANES == 8

/* Orders of a block, the bands of it that are summed at a time, and registers of lights that begin
 * side by side, for each waits for its roots and its quotient. */
#define FEW_ORDERS  (LMP_LANES / 2)
#define FEW_BLOCKS  ((FEW_BANDS + FEW_ORDERS - 1) / FEW_ORDERS)
#define FEW_AT_ONCE 3
#define FEW_AHEAD   4
#define FEW_SUMS    (FEW_BLOCKS * (FEW_BLOCKS + 1) / 2 * FEW_ORDERS)

/* Up to this many bands straight-line code takes all blocks at once, which have so many. */
#define FEW_STRAIGHT        10
#define FEW_STRAIGHT_BLOCKS ((FEW_STRAIGHT + FEW_ORDERS - 1) / FEW_ORDERS)
#define FEW_STRAIGHT_SUMS                                                                          \
    (FEW_STRAIGHT_BLOCKS * FEW_STRAIGHT -                                                          \
     FEW_STRAIGHT_BLOCKS * (FEW_STRAIGHT_BLOCKS - 1) / 2 * FEW_ORDERS)

/* Values of a light's row, of each block C_m, S_m and the bands, of whole registers: of the largest
 * block, or of all. And of a point's, which takes their place. */
#define FEW_ONE    (LMP_LANES + FEW_BANDS * FEW_ORDERS)
#define FEW_ALL    (FEW_STRAIGHT_BLOCKS * LMP_LANES + (FEW_STRAIGHT_SUMS + 1) * FEW_ORDERS)
#define FEW_ROW    ((FEW_ALL > FEW_ONE ? FEW_ALL : FEW_ONE) / LMP_LANES * LMP_LANES)
#define FEW_VALUES (3 * FEW_BANDS * FEW_BANDS)
#define FEW_PLANES (FEW_ROW * LMP_LANES > FEW_VALUES ? FEW_ROW * LMP_LANES : FEW_VALUES)

/* A register of lights: where they stand, and R_l. */
typedef struct few_lanes {
    accumulate_light light;
    vf rgb[3], radial[FEW_BANDS];
} few_lanes;

typedef struct few_work {
    few_lanes ahead[FEW_AHEAD];
    vf color[LMP_LANES][3];
    vf sums[FEW_SUMS][3];
    const float *rgb;
    float LMP_ALIGNED planes[FEW_PLANES];
    float LMP_ALIGNED rows[LMP_LANES * FEW_ROW];
} few_work;

/* Elements i, i + 1, … of an array that is no plane. */
static LMP_NOINLINE vf few_load_apart(const float *array, size_t stride, size_t i, size_t live) {
    float LMP_ALIGNED plane[LMP_LANES];
    for (size_t e = 0; e < LMP_LANES; e++)
        plane[e] = lights_at(array, stride, i + (e < live ? e : live - 1));
    return vf_load(plane);
}

/* Elements i, i + 1, … of an array; lanes past the last one have it again. */
LMP_INLINE vf few_load(const float *array, size_t stride, size_t i, size_t live) {
    static const float LMP_ALIGNED number[16] = { 0, 1, 2,  3,  4,  5,  6,  7,
                                                  8, 9, 10, 11, 12, 13, 14, 15 };
    if (stride != sizeof *array)
        return few_load_apart(array, stride, i, live);
    if (live == LMP_LANES)
        return vf_load(array + i);
    return vf_select_less(vf_load(number), vf_set((float)live), vf_load_first(array + i, (int)live),
                          vf_set(array[i + live - 1]));
}

/* Of lights i, i + 1, … what comes to a point, element `element` of the call. */
LMP_INLINE void few_hide(const lmp_kernel_lights *lights, size_t i, size_t live, size_t element,
                         cap_lanes *cap) {
    const size_t stride = lights->visibility_stride;
    const float *plane = lights->visibility + element;
    const vf visible = few_load(plane, stride * sizeof *plane, i, live);
    cap->s2 = cap->s2 * visible;
    cap->t_full = cap->t_full * visible;
}

LMP_INLINE void few_begin(int bands, const lmp_kernel_lights *lights, size_t i, size_t live,
                          const float point[3], size_t element, few_lanes *lanes) {
    const lmp_vec3_array *center = &lights->center;
    const accumulate_tile all = { 0, bands, 0, bands };
    cap_lanes cap = cap_from(few_load(center->x, center->stride, i, live) - point[0],
                             few_load(center->y, center->stride, i, live) - point[1],
                             few_load(center->z, center->stride, i, live) - point[2],
                             few_load(lights->radius.at, lights->radius.stride, i, live), 0);
    if (__builtin_expect(lights->visibility != NULL, 0))
        few_hide(lights, i, live, element, &cap);
    lanes->radial[0] = accumulate_begin(cap, &lanes->light);
    accumulate_radial(bands, all, 1, &lanes->light, lanes->radial);
    const lmp_vec3_array *radiance = &lights->radiance;
    lanes->rgb[0] = few_load(radiance->x, radiance->stride, i, live);
    lanes->rgb[1] = few_load(radiance->y, radiance->stride, i, live);
    lanes->rgb[2] = few_load(radiance->z, radiance->stride, i, live);
}

/* Bands of the blocks that begin with orders below `first`: a block has those from its first on. */
LMP_INLINE int few_bands(int bands, int first) {
    const int blocks = first / FEW_ORDERS;
    return blocks * bands - blocks * (blocks - 1) / 2 * FEW_ORDERS;
}

/* Planes of the same blocks. */
LMP_INLINE int few_values(int bands, int first) {
    return first / FEW_ORDERS * LMP_LANES + few_bands(bands, first) * FEW_ORDERS;
}

/* Planes of a block that no light has. */
LMP_INLINE void few_clear(int bands, int first, float *planes) {
    LMP_UNROLL for (int i = bands - first; i < FEW_ORDERS; i++) {
        vf_store(planes + i * LMP_LANES, vf_set(0));
        vf_store(planes + (FEW_ORDERS + i) * LMP_LANES, vf_set(0));
    }
    planes += LMP_LANES * LMP_LANES;
    const int rows = bands - first < FEW_ORDERS ? bands - first : FEW_ORDERS;
    LMP_UNROLL for (int k = 0; k < rows; k++) LMP_UNROLL for (int i = k + 1; i < FEW_ORDERS; i++)
        vf_store(planes + (k * FEW_ORDERS + i) * LMP_LANES, vf_set(0));
}

/* The same of the blocks before order `end`, and those that follow up to a multiple of LMP_LANES.
 */
LMP_INLINE void few_clear_all(int bands, int end, float *planes) {
    const int values = few_values(bands, end + FEW_ORDERS - 1);
    const int all = (values + LMP_LANES - 1) / LMP_LANES * LMP_LANES;
    LMP_UNROLL for (int first = 0; first < end; first += FEW_ORDERS)
        few_clear(bands, first, planes + few_values(bands, first) * LMP_LANES);
    LMP_UNROLL for (int v = values; v < all; v++) vf_store(planes + v * LMP_LANES, vf_set(0));
}

/* Orders of a block, from `first` on, of a register of lights: C_m and S_m in FEW_ORDERS planes
 * each, then as many of every band. */
LMP_INLINE void few_planes(int bands, int first, int monic, const vf *radial,
                           accumulate_light *light, float *planes) {
    const int end = first + FEW_ORDERS < bands ? first + FEW_ORDERS : bands;
    accumulate_column column = { .z = { light->z } };
    LMP_UNROLL for (int m = first; m < end; m++) {
        float *plane = planes + (m - first) * LMP_LANES;
        if (m > 0)
            accumulate_rotate(m, light);
        vf_store(plane, light->c);
        vf_store(plane + FEW_ORDERS * LMP_LANES, light->s);
        plane += LMP_LANES * LMP_LANES;
        accumulate_column_begin(m, monic, 1, &column);
        LMP_UNROLL for (int l = m; l < bands; l++) {
            if (l > m)
                accumulate_step(lmp_table_index(l, m), monic, 1, &column);
            vf_store(plane + (l - first) * FEW_ORDERS * LMP_LANES, column.q1[0] * radial[l]);
        }
    }
}

/* Adds `live` lights to the sums of `count` bands of a block, whose rows begin at `azimuths`, the
 * bands' at `rows`. Colors are found once for all bands, and kept if more follow. */
LMP_INLINE void few_sum(int count, int begins, int more, size_t live, few_work *work,
                        const float *azimuths, const float *rows, vf (*sums)[3]) {
    vf sum[FEW_AT_ONCE][3], color[3];
    LMP_UNROLL for (int k = 0; k < count; k++) LMP_UNROLL for (int c = 0; c < 3; c++) sum[k][c] =
        sums[k][c];
    LMP_ROLLED for (size_t e = 0; e < live; e++) {
        if (begins) {
            const vf azimuth = vf_load(azimuths + e * FEW_ROW);
            LMP_UNROLL for (int c = 0; c < 3; c++) color[c] =
                work->rgb[(size_t)c * LMP_LANES + e] * azimuth;
        } else {
            LMP_UNROLL for (int c = 0; c < 3; c++) color[c] = work->color[e][c];
        }
        if (begins && more)
            LMP_UNROLL for (int c = 0; c < 3; c++) work->color[e][c] = color[c];
        LMP_UNROLL for (int k = 0; k < count; k++) {
            const vf value = vf_load_twice(rows + e * FEW_ROW + k * FEW_ORDERS);
            LMP_UNROLL for (int c = 0; c < 3; c++) sum[k][c] = sum[k][c] + color[c] * value;
        }
    }
    LMP_UNROLL for (int k = 0; k < count; k++) LMP_UNROLL for (int c = 0; c < 3; c++) sums[k][c] =
        sum[k][c];
}

/* The same of `count` bands, however many: as many at once as there are registers for. */
LMP_INLINE void few_add(int count, size_t live, few_work *work, const float *azimuths,
                        vf (*sums)[3]) {
    const float *rows = azimuths + LMP_LANES;
    int k = 0;
    if (count > FEW_AT_ONCE) {
        few_sum(FEW_AT_ONCE, 1, 1, live, work, azimuths, rows, sums);
        for (k = FEW_AT_ONCE; k + FEW_AT_ONCE <= count; k += FEW_AT_ONCE)
            few_sum(FEW_AT_ONCE, 0, 0, live, work, azimuths, rows + k * FEW_ORDERS, sums + k);
    }
    LMP_UNROLL for (int left = 1; left <= FEW_AT_ONCE; left++) if (count - k == left)
        few_sum(left, k == 0, 0, live, work, azimuths, rows + k * FEW_ORDERS, sums + k);
}

/* Adds a register of lights to the sums of the blocks that begin with orders begin … end-1: all
 * their planes, then all their rows, then all sums, for each of these takes all registers. */
LMP_INLINE void few_blocks(int bands, int begin, int end, size_t live, few_lanes *lanes,
                           few_work *work) {
    const int monic = bands <= LMP_TABLE_MONIC_BANDS, before = few_values(bands, begin);
    const int values = few_values(bands, end + FEW_ORDERS - 1) - before;
    /* In registers: loads of many lights in turn would wait for stores of others. */
    accumulate_light light = lanes->light;
    LMP_UNROLL for (int first = begin; first < end; first += FEW_ORDERS)
        few_planes(bands, first, monic, lanes->radial, &light,
                   work->planes + (few_values(bands, first) - before) * LMP_LANES);
    if (end < bands)
        lanes->light = light;
    LMP_UNROLL for (int v = 0; v < values; v += LMP_LANES)
        layout_square(work->planes + v * LMP_LANES, work->rows + v, FEW_ROW);
    LMP_UNROLL for (int first = begin; first < end; first += FEW_ORDERS)
        few_add(bands - first, live, work, work->rows + (few_values(bands, first) - before),
                work->sums + few_bands(bands, first));
}

/* Adds the lights from light i on, FEW_AHEAD registers of them. */
LMP_INLINE void few_lights(int bands, int straight, const lmp_kernel_lights *lights, size_t i,
                           const float point[3], size_t element, few_work *work) {
    const size_t left = lights->count - i;
    const size_t end = left < FEW_AHEAD * LMP_LANES ? left : FEW_AHEAD * LMP_LANES;
    few_lanes *lanes = work->ahead;
    LMP_ROLLED for (size_t k = 0; k < end; k += LMP_LANES, lanes++)
        few_begin(bands, lights, i + k, layout_live(end, k), point, element, lanes);
    lanes = work->ahead;
    LMP_ROLLED for (size_t k = 0; k < end; k += LMP_LANES, lanes++) {
        work->rgb = (const float *)(const void *)lanes->rgb;
        if (straight)
            few_blocks(bands, 0, bands, layout_live(end, k), lanes, work);
        else
            for (int first = 0; first < bands; first += FEW_ORDERS)
                few_blocks(bands, first, first + 1, layout_live(end, k), lanes, work);
    }
}

/* What multiplies (l, m) in the end. */
LMP_INLINE float few_norm(int bands, int l, int m) {
    return bands <= LMP_TABLE_MONIC_BANDS ? lmp_table_norm[lmp_table_index(l, m)] : 1;
}

/* Writes the sums of orders first … of band l at both sides of the middle of its row, of three
 * planes of bands^2 values. */
LMP_INLINE void few_put_band(int bands, int first, int l, const vf sums[3], float *middle) {
    const int plane = bands * bands;
#if LMP_LANES == 8
    if (first + FEW_ORDERS <= l + 1) {
        const __m128 norm =
            _mm_setr_ps(few_norm(bands, l, first), few_norm(bands, l, first + 1),
                        few_norm(bands, l, first + 2), few_norm(bands, l, first + 3));
        LMP_UNROLL for (int c = 0; c < 3; c++) {
            const __m128 cosines = _mm256_castps256_ps128((__m256)sums[c]);
            const __m128 sines = norm * _mm256_extractf128_ps((__m256)sums[c], 1);
            float *to = middle + c * plane;
            /* Before the cosines: that of order 0 is no value. */
            _mm_storeu_ps(to - first - 3, _mm_shuffle_ps(sines, sines, _MM_SHUFFLE(0, 1, 2, 3)));
            _mm_storeu_ps(to + first, norm * cosines);
        }
        return;
    }
#endif
    const float *sum = (const float *)(const void *)sums;
    const int end = l + 1 < first + FEW_ORDERS ? l + 1 : first + FEW_ORDERS;
    LMP_UNROLL for (int m = first; m < end; m++, sum++) {
        const float norm = few_norm(bands, l, m);
        LMP_UNROLL for (int c = 0; c < 3; c++) {
            if (m > 0)
                middle[c * plane - m] = norm * sum[c * LMP_LANES + FEW_ORDERS];
            middle[c * plane + m] = norm * sum[c * LMP_LANES];
        }
    }
}

/* Writes a block, which begins with order `first`. */
LMP_INLINE void few_put(int bands, int first, vf (*sums)[3], float *row) {
    LMP_UNROLL for (int l = first; l < bands; l++)
        few_put_band(bands, first, l, sums[l - first], row + l * l + l);
}

/* The sums of the lights at one point, which is element `element` of the output. */
LMP_INLINE void few_point(int bands, int straight, const lmp_kernel_lights *lights,
                          const float point[3], const lmp_kernel_out *out, size_t element,
                          few_work *work) {
    const int count = few_bands(bands, bands + FEW_ORDERS - 1);
    for (int k = 0; k < count; k++)
        LMP_UNROLL for (int c = 0; c < 3; c++) work->sums[k][c] = vf_set(0);
    few_clear_all(bands, straight ? bands : 1, work->planes);
    for (size_t i = 0; i < lights->count; i += FEW_AHEAD * LMP_LANES)
        few_lights(bands, straight, lights, i, point, element, work);
    float *row = out->planar ? work->planes : out->at + element * out->stride;
    if (straight)
        LMP_UNROLL for (int first = 0; first < bands; first += FEW_ORDERS)
            few_put(bands, first, work->sums + few_bands(bands, first), row);
    else
        for (int first = 0; first < bands; first += FEW_ORDERS)
            few_put(bands, first, work->sums + few_bands(bands, first), row);
    for (size_t v = 0; out->planar && v < (size_t)(3 * bands * bands); v++)
        out->at[v * out->stride + element] = row[v];
}

static LMP_NOINLINE void accumulate_few(int bands, const lmp_kernel_lights *lights,
                                        const float point[3], const lmp_kernel_out *out,
                                        size_t element) {
    few_work work;
    switch (bands) {
        LMP_SMALL_CASES(few_point, 1, lights, point, out, element, &work)
    default:
        few_point(bands, 0, lights, point, out, element, &work);
    }
}

/* The points from `element` on, fewer than there are lanes or as many. */
static void accumulate_points(const lmp_scratch *scratch, int bands,
                              const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                              const lmp_kernel_out *out, size_t element, size_t live) {
    if (!few_pays(bands, lights->count, live)) {
        accumulate_block(scratch, bands, lights, points, out, element, live);
        return;
    }
    for (size_t e = element; e < element + live; e++) {
        const float point[3] = { points->x[e], points->y[e], points->z[e] };
        accumulate_few(bands, lights, point, out, e);
    }
}

#elif LMP_LANES == 16

/* Points that leave half of the lanes alone cost less by AVX2, with the same bits. */
static void accumulate_points(const lmp_scratch *scratch, int bands,
                              const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                              const lmp_kernel_out *out, size_t element, size_t live) {
    if (live > LMP_LANES / 2) {
        accumulate_block(scratch, bands, lights, points, out, element, live);
        return;
    }
    if (element == 0) {
        lmp_kernels_avx2.accumulate(scratch, bands, lights, points, live, out);
        return;
    }
    const lmp_kernel_vec3 some = { points->x + element, points->y + element, points->z + element };
    lmp_kernel_lights seen = *lights;
    lmp_kernel_out to = *out;
    if (seen.visibility)
        seen.visibility += element;
    to.at += out->planar ? element : element * out->stride;
    lmp_kernels_avx2.accumulate(scratch, bands, &seen, &some, live, &to);
}

#else
#define accumulate_points accumulate_block
#endif

static void kernel_accumulate(const lmp_scratch *scratch, int bands,
                              const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                              size_t count, const lmp_kernel_out *out) {
    for (size_t e = 0; e < count; e += LMP_LANES)
        accumulate_points(scratch, bands, lights, points, out, e, layout_live(count, e));
}

#endif
