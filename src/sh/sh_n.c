/* SPDX-License-Identifier: MIT */
#include "src/kernels/batch.h"
#include "src/kernels/dispatch.h"
#include "src/sh/layout.h"

#include <lampion/sh.h>

void lmp_sh_eval_n(int bands, lmp_vec3_array directions, size_t count, lmp_sh_array sh) {
    const size_t values = LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands) && lmpi_is_sh_array(sh, values, count));
    assert(lmpi_are_unit(directions, count));
    const lmpi_kernels *kernels = lmpi_kernels_get();
    const lmpi_kernel_out all = lmpi_sh_array_all(sh, values, count);
    const bool streams = lmpi_batch_streams(&all, values, count);
    lmpi_batch_room room;
    for (size_t first = 0, n; first < count; first += n) {
        n = lmpi_batch_chunk(&all, streams, count, first);
        const lmpi_kernel_vec3 vectors =
            lmpi_batch_vectors(&directions, first, n, lmpi_batch_in(&room));
        const lmpi_kernel_out out = lmpi_batch_from(&all, first);
        (streams ? kernels->sh.eval_streamed : kernels->sh.eval)(bands, &vectors, n, &out);
    }
    if (streams)
        lmpi_batch_fence();
}

void lmp_sh_eval_gradient_n(int bands, lmp_vec3_array directions, size_t count, lmp_sh_array sh,
                            lmp_sh_array gradient) {
    const size_t values = LMP_SH_COUNT(bands);
    assert(lmpi_is_bands(bands) && lmpi_is_sh_array(sh, values, count));
    assert(lmpi_is_sh_array(gradient, 3 * values, count));
    assert(lmpi_are_unit(directions, count));
    lmpi_batch_room room;
    for (size_t first = 0; first < count; first += LMPI_BATCH) {
        const size_t n = lmpi_batch_count(count, first);
        const lmpi_kernel_vec3 vectors =
            lmpi_batch_vectors(&directions, first, n, lmpi_batch_in(&room));
        const lmpi_kernel_out out = lmpi_sh_array_from(sh, values, count, first);
        const lmpi_kernel_out slopes = lmpi_sh_array_from(gradient, 3 * values, count, first);
        lmpi_kernels_get()->sh.eval_gradient(bands, &vectors, n, &out, &slopes);
    }
}

static lmpi_kernel_in batch_in(int bands, const float *at, size_t count, lmp_sh_layout layout,
                               size_t stride) {
    const int planar = layout == LMP_SH_PLANAR;
    return (lmpi_kernel_in) { at, lmpi_batch_stride(stride, planar ? count : LMP_SH_COUNT(bands)),
                              planar };
}

void lmp_sh_dot_n(int bands, lmp_sh_layout layout, size_t stride, const float *a, const float *b,
                  size_t count, float *dots) {
    assert(lmpi_is_bands(bands) && lmpi_is_layout(layout, stride, LMP_SH_COUNT(bands), count));
    if (count == 0)
        return;
    const lmpi_kernel_in from_a = batch_in(bands, a, count, layout, stride);
    const lmpi_kernel_in from_b = batch_in(bands, b, count, layout, stride);
    lmpi_kernels_get()->sh.dot(LMP_SH_COUNT(bands), &from_a, &from_b, count, dots);
}

void lmp_sh_rotate_n(int bands, const float *matrices, const float *sh, size_t count,
                     lmp_sh_array rotated) {
    assert(lmpi_is_bands(bands) && lmpi_is_sh_array(rotated, LMP_SH_COUNT(bands), count));
    if (count == 0)
        return;
    const size_t extent =
        lmpi_layout_extent(rotated.layout, rotated.stride, LMP_SH_COUNT(bands), count);
    assert(lmpi_are_apart(sh, extent, rotated.at, extent));
    (void)extent;
    const lmpi_kernel_in in = batch_in(bands, sh, count, rotated.layout, rotated.stride);
    const lmpi_kernel_out out = lmpi_sh_array_all(rotated, LMP_SH_COUNT(bands), count);
    lmpi_kernels_get()->sh.rotate(bands, matrices, &in, count, &out);
}
