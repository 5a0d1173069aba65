/* SPDX-License-Identifier: MIT */
/* accumulate_few.h - many RGB lights into one point: lanes are lights.
 *
 * A register of products, one coefficient of LMP_LANES lights, becomes rows of a light each,
 * which are added in the order of the lights, by the operations of accumulate.h in their order: the
 * same bits. */
#ifndef LAMPION_KERNELS_ACCUMULATE_FEW_H
#define LAMPION_KERNELS_ACCUMULATE_FEW_H

#include "src/kernels/accumulate.h"

/* Points that are few; and the bands whose sums fit the stack. */
#define FEW_POINTS 3
#define FEW_BANDS  32
#define FEW_SUMS   (3 * FEW_BANDS * FEW_BANDS)

/* Products that wait; a pair (l, m) has six at most. */
#define FEW_WAITING 128
#define FEW_PAIR    6

typedef struct few_sums {
    float LMP_ALIGNED sums[FEW_SUMS + LMP_KERNEL_LANES_MAX];
    float LMP_ALIGNED products[(FEW_WAITING + FEW_PAIR) * LMP_LANES];
    float LMP_ALIGNED rows[LMP_LANES * FEW_WAITING];
    int first, waiting; /* sum of the first product that waits, and their number */
} few_sums;

/* Whether `live` points cost less one by one: as measured, where the registers of lights are fewer
 * than a quarter of the lights, which a block of points takes a register each. */
LMP_INLINE int few_pays(int bands, size_t lights, size_t live) {
    const size_t registers = live * ((lights + LMP_LANES - 1) / LMP_LANES);
    return LMP_LANES > 1 && bands <= FEW_BANDS && live <= FEW_POINTS && 4 * registers <= lights;
}

/* Adds the first `count` products that wait, of `live` lights; the others are the first then. */
LMP_INLINE void few_add(few_sums *few, int count, size_t live) {
    layout_rows(few->products, (size_t)count, few->rows, FEW_WAITING, LMP_LANES);
    for (int v = 0; v < count; v += LMP_LANES) {
        vf sum = vf_load(few->sums + few->first + v);
        for (size_t e = 0; e < live; e++)
            sum = sum + vf_load(few->rows + e * FEW_WAITING + v);
        vf_store(few->sums + few->first + v, sum);
    }
    few->first += count;
    few->waiting -= count;
    memmove(few->products, few->products + count * LMP_LANES,
            (size_t)few->waiting * LMP_LANES * sizeof(float));
}

/* Of lights i, i + 1, … what comes to a point, element `element` of the call. */
LMP_INLINE void few_hide(const lmp_kernel_lights *lights, size_t i, size_t live, size_t element,
                         cap_lanes *caps) {
    float LMP_ALIGNED visible[LMP_LANES] = { 0 };
    for (size_t e = 0; e < live; e++)
        visible[e] = lights->visibility[(i + e) * lights->visibility_stride + element];
    caps->s2 = caps->s2 * vf_load(visible);
    caps->t_full = caps->t_full * vf_load(visible);
}

/* Lights i, i + 1, …: their caps seen from `point`, and their radiance. Lanes past the last light
 * have that light again. */
LMP_INLINE cap_lanes few_caps(const lmp_kernel_lights *lights, size_t i, size_t live,
                              const float point[3], vf rgb[3]) {
    float LMP_ALIGNED planes[7][LMP_LANES];
    for (size_t e = 0; e < LMP_LANES; e++) {
        const size_t light = i + (e < live ? e : live - 1);
        const lmp_rgb radiance = lights_radiance(lights, light);
        planes[0][e] = lights_at(lights->center.x, lights->center.stride, light);
        planes[1][e] = lights_at(lights->center.y, lights->center.stride, light);
        planes[2][e] = lights_at(lights->center.z, lights->center.stride, light);
        planes[3][e] = lights_at(lights->radius.at, lights->radius.stride, light);
        planes[4][e] = radiance.r;
        planes[5][e] = radiance.g;
        planes[6][e] = radiance.b;
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = vf_load(planes[4 + c]);
    return cap_from(vf_load(planes[0]) - point[0], vf_load(planes[1]) - point[1],
                    vf_load(planes[2]) - point[2], vf_load(planes[3]), 0);
}

/* Adds `live` lights from light i on; sums follow one another by m, then l, then as in a tile. */
LMP_INLINE void few_lights(int bands, int monic, const lmp_kernel_lights *lights, size_t i,
                           const float point[3], size_t element, few_sums *few) {
    const size_t live = layout_live(lights->count, i);
    accumulate_light light;
    accumulate_column column;
    vf rgb[3], radial[FEW_BANDS];
    cap_lanes cap = few_caps(lights, i, live, point, rgb);
    if (__builtin_expect(lights->visibility != NULL, 0))
        few_hide(lights, i, live, element, &cap);
    radial[0] = accumulate_begin(cap, &light);
    accumulate_radial(bands, accumulate_first(bands, FEW_SUMS), 1, &light, radial);
    column.z[0] = light.z;
    few->first = few->waiting = 0;
    for (int m = 0; m < bands; m++) {
        if (m > 0)
            accumulate_rotate(m, &light);
        const vf color[6] = { rgb[0] * light.c, rgb[1] * light.c, rgb[2] * light.c,
                              rgb[0] * light.s, rgb[1] * light.s, rgb[2] * light.s };
        accumulate_column_begin(m, monic, 1, &column);
        for (int l = m; l < bands; l++) {
            if (l > m)
                accumulate_step(lmp_table_index(l, m), monic, 1, &column);
            const vf value = column.q1[0] * radial[l];
            float *to = few->products + few->waiting * LMP_LANES;
            LMP_UNROLL for (int j = 0; j < 6; j++) vf_store(to + j * LMP_LANES, color[j] * value);
            few->waiting += m == 0 ? 3 : 6;
            if (few->waiting >= FEW_WAITING)
                few_add(few, FEW_WAITING, live);
        }
    }
    for (; few->waiting % LMP_LANES; few->waiting++)
        vf_store(few->products + few->waiting * LMP_LANES, vf_set(0));
    few_add(few, few->waiting, live);
}

/* The sums of the lights at one point, which is element `element` of the output. */
static LMP_NOINLINE void accumulate_few(int bands, const lmp_kernel_lights *lights,
                                        const float point[3], const lmp_kernel_out *out,
                                        size_t element) {
    const int monic = bands <= LMP_TABLE_MONIC_BANDS;
    const size_t step = out->planar ? out->stride : 1;
    float *to = out->at + element * (out->planar ? 1 : out->stride);
    few_sums few;
    memset(few.sums, 0, (size_t)(3 * bands * bands + LMP_LANES) * sizeof *few.sums);
    for (size_t i = 0; i < lights->count; i += LMP_LANES)
        few_lights(bands, monic, lights, i, point, element, &few);
    const float *sum = few.sums;
    for (int m = 0; m < bands; m++)
        for (int l = m; l < bands; l++, sum += m == 0 ? 3 : 6) {
            const float norm = monic ? lmp_table_norm[lmp_table_index(l, m)] : 1;
            for (int c = 0; c < 3; c++) {
                const int middle = c * bands * bands + l * l + l;
                to[(size_t)(middle + m) * step] = norm * sum[c];
                if (m > 0)
                    to[(size_t)(middle - m) * step] = norm * sum[3 + c];
            }
        }
}

static void kernel_accumulate(const lmp_scratch *scratch, int bands,
                              const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                              size_t count, const lmp_kernel_out *out) {
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
