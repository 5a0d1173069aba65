/* SPDX-License-Identifier: MIT */
/* accumulate_more_tmpl.h - the kernels that sum lights at points, and those that add the sum to the
 * output: the sum has the same bits, and is added once. For few points the sums are computed one by
 * one. */
#ifndef LAMPION_KERNELS_ACCUMULATE_MORE_TMPL_H
#define LAMPION_KERNELS_ACCUMULATE_MORE_TMPL_H

#include "src/kernels/accumulate_tmpl.h"

/* Sums lights at points. accumulate_points, which takes up to LMPI_LANES points from `element` on,
 * is chosen by the build (build_tmpl.h). */
static void kernel_accumulate(const lmp_scratch *scratch, int bands,
                              const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                              size_t count, const lmpi_kernel_out *out) {
    for (size_t e = 0; e < count; e += LMPI_LANES)
        accumulate_points(scratch, bands, lights, points, out, e, layout_live(count, e));
}

/* Bands whose sums at one point fit the stack beside what computes them. */
#define MORE_BANDS 20

static LMPI_NOINLINE void more_point(int bands, const lmpi_kernel_lights *lights,
                                     const lmpi_kernel_vec3 *points, const lmpi_kernel_out *out,
                                     size_t element) {
    const size_t values = (size_t)(3 * bands * bands);
    const float *const from[3] = { points->x, points->y, points->z };
    float LMPI_ALIGNED at[3][LMPI_KERNEL_LANES_MAX], LMPI_ALIGNED sums[3 * MORE_BANDS * MORE_BANDS];
    const lmpi_kernel_vec3 point = { at[0], at[1], at[2] };
    const lmpi_kernel_out alone = { sums, values, 0 };
    lmpi_kernel_lights its = *lights;
    if (lights->visibility)
        its.visibility = lights->visibility + element;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < LMPI_KERNEL_LANES_MAX; i++)
            at[c][i] = from[c][element];
    kernel_accumulate(NULL, bands, &its, &point, 1, &alone);
    float *to = out->at + element * (out->planar ? 1 : out->stride);
    const size_t step = out->planar ? out->stride : 1;
    for (size_t v = 0; v < values; v++)
        to[v * step] = to[v * step] + sums[v];
}

static void kernel_accumulate_more(const lmp_scratch *scratch, int bands,
                                   const lmpi_kernel_lights *lights, const lmpi_kernel_vec3 *points,
                                   size_t count, const lmpi_kernel_out *out) {
    lmpi_kernel_lights adding = *lights;
    adding.adds = 1;
    for (size_t e = 0; e < count; e += LMPI_LANES) {
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
