/* SPDX-License-Identifier: MIT */
/* accumulate_few.h - many RGB lights into one point: lanes are lights, then orders m.
 *
 * What a register of lights has of a block of orders, C_m and S_m, then the values q_l^m R_l by
 * diagonals l - m, is transposed to a row a light. A register of a row is the same orders twice,
 * for cosines and for sines, so that one product with the light's colors and one sum serve both.
 * Lights are added in their order by the operations of accumulate.h: the same bits. */
#ifndef LAMPION_KERNELS_ACCUMULATE_FEW_H
#define LAMPION_KERNELS_ACCUMULATE_FEW_H

#include "src/kernels/accumulate.h"

/* Points that are few, as measured: below 5 bands the sums of 16 lanes take less; and the bands
 * whose sums fit the stack. */
#define FEW_POINTS(bands)                                                                          \
    (LMP_LANES == 16 ? (bands) < 5 ? 3 : 4 : LMP_LANES == 8 ? 3 : LMP_LANES == 4 ? 1 : 0)
#define FEW_BANDS 32

/* Orders of a block, and the diagonals of it that are summed at a time. */
#define FEW_ORDERS  (LMP_LANES > 1 ? LMP_LANES / 2 : 1)
#define FEW_BLOCKS  ((FEW_BANDS + FEW_ORDERS - 1) / FEW_ORDERS)
#define FEW_AT_ONCE (LMP_LANES == 16 ? 6 : 3)
#define FEW_SUMS    (FEW_BLOCKS * (FEW_BLOCKS + 1) / 2 * FEW_ORDERS)

/* Values of a light's row, C_m, S_m and the diagonals; and of a point's, which takes their place.
 */
#define FEW_ROW    (LMP_LANES + FEW_BANDS * FEW_ORDERS)
#define FEW_VALUES (3 * FEW_BANDS * FEW_BANDS)
#define FEW_PLANES (FEW_ROW * LMP_LANES > FEW_VALUES ? FEW_ROW * LMP_LANES : FEW_VALUES)

typedef struct few_work {
    vf sums[FEW_SUMS][3];
    float LMP_ALIGNED rgb[3][LMP_LANES];
    float LMP_ALIGNED planes[FEW_PLANES];
    float LMP_ALIGNED rows[LMP_LANES * FEW_ROW];
} few_work;

/* A register of lights: where they stand, and R_l. */
typedef struct few_lanes {
    accumulate_light light;
    vf radial[FEW_BANDS];
} few_lanes;

/* Whether `live` points cost less one by one, as measured: a block of them costs as much as one. */
LMP_INLINE int few_pays(int bands, size_t lights, size_t live) {
    return bands <= FEW_BANDS && live <= FEW_POINTS(bands) && 8 * live <= lights + 13;
}

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
}

/* The order after the block that begins with `first`. */
static inline int few_end(int bands, int first) {
    return first + FEW_ORDERS < bands ? first + FEW_ORDERS : bands;
}

/* Planes of a block that no light has, and those that follow up to a multiple of LMP_LANES. */
LMP_INLINE void few_clear(int bands, float *planes) {
    const int rest = (LMP_LANES - bands * FEW_ORDERS % LMP_LANES) % LMP_LANES;
    LMP_UNROLL for (int m = bands; m < FEW_ORDERS; m++) {
        vf_store(planes + m * LMP_LANES, vf_set(0));
        vf_store(planes + (FEW_ORDERS + m) * LMP_LANES, vf_set(0));
    }
    planes += LMP_LANES * LMP_LANES;
    LMP_UNROLL for (int k = bands - FEW_ORDERS > 0 ? bands - FEW_ORDERS + 1 : 0; k < bands; k++)
        LMP_UNROLL for (int m = bands - k; m < FEW_ORDERS; m++)
            vf_store(planes + (k * FEW_ORDERS + m) * LMP_LANES, vf_set(0));
    LMP_UNROLL for (int v = 0; v < rest; v++)
        vf_store(planes + (bands * FEW_ORDERS + v) * LMP_LANES, vf_set(0));
}

/* Orders first … end-1 of a register of lights: C_m and S_m in FEW_ORDERS planes each, then as many
 * of every diagonal. */
LMP_INLINE void few_planes(int bands, int first, int end, int monic, few_lanes *lanes,
                           float *planes) {
    accumulate_column column = { .z = { lanes->light.z } };
    LMP_UNROLL for (int m = first; m < end; m++) {
        float *plane = planes + (m - first) * LMP_LANES;
        if (m > 0)
            accumulate_rotate(m, &lanes->light);
        vf_store(plane, lanes->light.c);
        vf_store(plane + FEW_ORDERS * LMP_LANES, lanes->light.s);
        plane += LMP_LANES * LMP_LANES;
        accumulate_column_begin(m, monic, 1, &column);
        LMP_UNROLL for (int l = m; l < bands; l++) {
            if (l > m)
                accumulate_step(lmp_table_index(l, m), monic, 1, &column);
            vf_store(plane + (l - m) * FEW_ORDERS * LMP_LANES, column.q1[0] * lanes->radial[l]);
        }
    }
}

/* Adds to the sums of `count` diagonals of a block, of which the first is at `rows`, those of
 * `live` lights. */
LMP_INLINE void few_sum(int count, size_t live, const few_work *work, const float *rows,
                        vf (*sums)[3]) {
    vf sum[FEW_AT_ONCE][3];
    const float *azimuths = work->rows;
    LMP_UNROLL for (int k = 0; k < count; k++) LMP_UNROLL for (int c = 0; c < 3; c++) sum[k][c] =
        sums[k][c];
    LMP_ROLLED for (size_t e = 0; e < live; e++) {
        const vf azimuth = vf_load(azimuths + e * FEW_ROW);
        vf color[3];
        LMP_UNROLL for (int c = 0; c < 3; c++) color[c] = work->rgb[c][e] * azimuth;
        LMP_UNROLL for (int k = 0; k < count; k++) {
            const vf value = vf_load_twice(rows + e * FEW_ROW + k * FEW_ORDERS);
            LMP_UNROLL for (int c = 0; c < 3; c++) sum[k][c] = sum[k][c] + color[c] * value;
        }
    }
    LMP_UNROLL for (int k = 0; k < count; k++) LMP_UNROLL for (int c = 0; c < 3; c++) sums[k][c] =
        sum[k][c];
}

/* Adds to the sums of a block those of `live` lights. */
LMP_INLINE void few_add(int diagonals, size_t live, const few_work *work, vf (*sums)[3]) {
    const float *rows = work->rows + LMP_LANES;
    int k = 0;
    for (; k + FEW_AT_ONCE <= diagonals; k += FEW_AT_ONCE)
        few_sum(FEW_AT_ONCE, live, work, rows + k * FEW_ORDERS, sums + k);
    for (; k < diagonals; k++)
        few_sum(1, live, work, rows + k * FEW_ORDERS, sums + k);
}

/* Adds the lights from light i on, a register of them. */
LMP_INLINE void few_lights(int bands, int monic, const lmp_kernel_lights *lights, size_t i,
                           const float point[3], size_t element, few_work *work) {
    const size_t live = layout_live(lights->count, i);
    const lmp_vec3_array *radiance = &lights->radiance;
    few_lanes lanes;
    vf(*sums)[3] = work->sums;
    few_begin(bands, lights, i, live, point, element, &lanes);
    vf_store(work->rgb[0], few_load(radiance->x, radiance->stride, i, live));
    vf_store(work->rgb[1], few_load(radiance->y, radiance->stride, i, live));
    vf_store(work->rgb[2], few_load(radiance->z, radiance->stride, i, live));
    for (int first = 0; first < bands; first += FEW_ORDERS) {
        const int diagonals = bands - first;
        few_planes(bands, first, few_end(bands, first), monic, &lanes, work->planes);
        layout_squares(work->planes, (size_t)(LMP_LANES + diagonals * FEW_ORDERS), work->rows,
                       FEW_ROW);
        few_add(diagonals, live, work, sums);
        sums += diagonals;
    }
}

/* The values of orders first … end-1, at their positions in a row. */
LMP_INLINE void few_put(int bands, int first, int end, int monic, vf (*sums)[3], float *row) {
    const int plane = bands * bands;
    LMP_UNROLL for (int k = 0; k < bands - first; k++) {
        const float *sum = (const float *)(const void *)sums[k];
        const int after = end < bands - k ? end : bands - k;
        LMP_UNROLL for (int m = first; m < after; m++) {
            const int l = m + k, middle = l * l + l, i = m - first;
            const float norm = monic ? lmp_table_norm[lmp_table_index(l, m)] : 1;
            LMP_UNROLL for (int c = 0; c < 3; c++) {
                row[c * plane + middle + m] = norm * sum[c * LMP_LANES + i];
                if (m > 0)
                    row[c * plane + middle - m] = norm * sum[c * LMP_LANES + FEW_ORDERS + i];
            }
        }
    }
}

/* The sums of the lights at one point, which is element `element` of the output. */
LMP_INLINE void few_point(int bands, const lmp_kernel_lights *lights, const float point[3],
                          const lmp_kernel_out *out, size_t element, few_work *work) {
    const int monic = bands <= LMP_TABLE_MONIC_BANDS;
    vf(*sums)[3] = work->sums;
    for (int first = 0; first < bands; first += FEW_ORDERS)
        LMP_UNROLL for (int k = first; k < bands; k++, sums++)
            LMP_UNROLL for (int c = 0; c < 3; c++)(*sums)[c] = vf_set(0);
    few_clear(bands, work->planes);
    for (size_t i = 0; i < lights->count; i += LMP_LANES)
        few_lights(bands, monic, lights, i, point, element, work);
    float *row = out->planar ? work->planes : out->at + element * out->stride;
    sums = work->sums;
    for (int first = 0; first < bands; first += FEW_ORDERS) {
        few_put(bands, first, few_end(bands, first), monic, sums, row);
        sums += bands - first;
    }
    for (size_t v = 0; out->planar && v < (size_t)(3 * bands * bands); v++)
        out->at[v * out->stride + element] = row[v];
}

static LMP_NOINLINE void accumulate_few(int bands, const lmp_kernel_lights *lights,
                                        const float point[3], const lmp_kernel_out *out,
                                        size_t element) {
    few_work work;
    LMP_STRAIGHT(bands, few_point, lights, point, out, element, &work)
}

/* Lights that fill no more than the lanes of AVX2 cost less there, with the same bits. */
#if LMP_LANES == 16
#define FEW_LIGHTS 8
extern const lmp_kernels lmp_kernels_avx2;
#endif

static void kernel_accumulate(const lmp_scratch *scratch, int bands,
                              const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                              size_t count, const lmp_kernel_out *out) {
#if LMP_LANES == 16
    if (lights->count <= FEW_LIGHTS && few_pays(bands, lights->count, count)) {
        lmp_kernels_avx2.accumulate(scratch, bands, lights, points, count, out);
        return;
    }
#endif
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const size_t live = layout_live(count, e);
        if (!few_pays(bands, lights->count, live)) {
            accumulate_block(scratch, bands, lights, points, out, e, live);
            continue;
        }
        for (size_t i = e; i < e + live; i++) {
            const float point[3] = { points->x[i], points->y[i], points->z[i] };
            accumulate_few(bands, lights, point, out, i);
        }
    }
}

#endif
