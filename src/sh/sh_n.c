/* SPDX-License-Identifier: MIT */
#include "src/kernels/batch.h"
#include "src/sh/layout.h"

#include <lampion/sh.h>

void lmp_sh_eval_n(int bands, lmp_vec3_array directions, size_t count, lmp_sh_layout layout,
                   size_t stride, float *sh) {
    const size_t values = LMP_SH_COUNT(bands);
    const int planar = layout == LMP_SH_PLANAR;
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, values, count));
    assert(lmp_are_unit(directions, count));
    const lmp_kernels *kernels = lmp_kernels_get();
    const lmp_kernel_out all = lmp_batch_all(sh, values, count, planar, stride);
    const bool streams = lmp_batch_streams(&all, values, count);
    lmp_batch_room room;
    for (size_t first = 0, n; first < count; first += n) {
        n = lmp_batch_chunk(&all, streams, count, first);
        const lmp_kernel_vec3 vectors =
            lmp_batch_vectors(&directions, first, n, lmp_batch_in(&room));
        const lmp_kernel_out out = lmp_batch_from(&all, first);
        (streams ? kernels->eval_streamed : kernels->eval)(bands, &vectors, n, &out);
    }
    if (streams)
        lmp_batch_fence();
}

void lmp_sh_eval_gradient_n(int bands, lmp_vec3_array directions, size_t count,
                            lmp_sh_layout layout, size_t stride, float *sh, size_t gradient_stride,
                            float *gradient) {
    const size_t values = LMP_SH_COUNT(bands);
    const int planar = layout == LMP_SH_PLANAR;
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, values, count));
    assert(lmp_is_layout(layout, gradient_stride, 3 * values, count));
    assert(lmp_are_unit(directions, count));
    lmp_batch_room room;
    for (size_t first = 0; first < count; first += LMP_BATCH) {
        const size_t n = lmp_batch_count(count, first);
        const lmp_kernel_vec3 vectors =
            lmp_batch_vectors(&directions, first, n, lmp_batch_in(&room));
        const lmp_kernel_out out = lmp_batch_out(sh, values, count, planar, stride, first);
        const lmp_kernel_out slopes =
            lmp_batch_out(gradient, 3 * values, count, planar, gradient_stride, first);
        lmp_kernels_get()->eval_gradient(bands, &vectors, n, &out, &slopes);
    }
}

static lmp_kernel_in batch_in(int bands, const float *at, size_t count, lmp_sh_layout layout,
                              size_t stride) {
    const int planar = layout == LMP_SH_PLANAR;
    return (lmp_kernel_in) { at, lmp_batch_stride(stride, planar ? count : LMP_SH_COUNT(bands)),
                             planar };
}

void lmp_sh_dot_n(int bands, const float *a, const float *b, size_t count, lmp_sh_layout layout,
                  size_t stride, float *dots) {
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, LMP_SH_COUNT(bands), count));
    if (count == 0)
        return;
    const lmp_kernel_in from_a = batch_in(bands, a, count, layout, stride);
    const lmp_kernel_in from_b = batch_in(bands, b, count, layout, stride);
    lmp_kernels_get()->dot(LMP_SH_COUNT(bands), &from_a, &from_b, count, dots);
}

void lmp_sh_rotate_n(int bands, const float *matrices, const float *sh, size_t count,
                     lmp_sh_layout layout, size_t stride, float *rotated) {
    assert(lmp_is_bands(bands) && lmp_is_layout(layout, stride, LMP_SH_COUNT(bands), count));
    if (count == 0)
        return;
    const size_t extent = lmp_layout_extent(layout, stride, LMP_SH_COUNT(bands), count);
    assert(lmp_are_apart(sh, extent, rotated, extent));
    (void)extent;
    const lmp_kernel_in in = batch_in(bands, sh, count, layout, stride);
    const lmp_kernel_out out =
        lmp_batch_out(rotated, LMP_SH_COUNT(bands), count, layout == LMP_SH_PLANAR, stride, 0);
    lmp_kernels_get()->rotate(bands, matrices, &in, count, &out);
}
