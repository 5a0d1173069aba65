/* SPDX-License-Identifier: MIT */
/* accumulate_more.h - lights into points that hold some: their sum, the one of accumulate.h bit for
 * bit, is added to the output, once. Of few points the sums are made one by one. */
#ifndef LAMPION_KERNELS_ACCUMULATE_MORE_H
#define LAMPION_KERNELS_ACCUMULATE_MORE_H

#include "src/kernels/accumulate_few.h"

/* Bands whose sums at one point find room beside what they take. */
#define MORE_BANDS 20

static LMP_NOINLINE void more_point(int bands, const lmp_kernel_lights *lights,
                                    const lmp_kernel_vec3 *points, const lmp_kernel_out *out,
                                    size_t element) {
    const size_t values = (size_t)(3 * bands * bands);
    const float *const from[3] = { points->x, points->y, points->z };
    float LMP_ALIGNED at[3][LMP_KERNEL_LANES_MAX], LMP_ALIGNED sums[3 * MORE_BANDS * MORE_BANDS];
    const lmp_kernel_vec3 point = { at[0], at[1], at[2] };
    const lmp_kernel_out alone = { sums, values, 0 };
    lmp_kernel_lights its = *lights;
    if (lights->visibility)
        its.visibility = lights->visibility + element;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < LMP_KERNEL_LANES_MAX; i++)
            at[c][i] = from[c][element];
    kernel_accumulate(NULL, bands, &its, &point, 1, &alone);
    float *to = out->at + element * (out->planar ? 1 : out->stride);
    const size_t step = out->planar ? out->stride : 1;
    for (size_t v = 0; v < values; v++)
        to[v * step] = to[v * step] + sums[v];
}

static void kernel_accumulate_more(const lmp_scratch *scratch, int bands,
                                   const lmp_kernel_lights *lights, const lmp_kernel_vec3 *points,
                                   size_t count, const lmp_kernel_out *out) {
    lmp_kernel_lights adding = *lights;
    adding.adds = 1;
    for (size_t e = 0; e < count; e += LMP_LANES) {
        const size_t live = layout_live(count, e);
        if (bands > MORE_BANDS || !few_pays(bands, lights->count, live)) {
            accumulate_block(scratch, bands, &adding, points, out, e, live);
            continue;
        }
        for (size_t i = e; i < e + live; i++)
            more_point(bands, lights, points, out, i);
    }
}

#endif
