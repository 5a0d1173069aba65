/* SPDX-License-Identifier: MIT */
/* layout.h - the requirements on a caller's layout and stride (lampion/sh.h), and the extent of a
 * result. */
#ifndef LAMPION_SH_LAYOUT_H
#define LAMPION_SH_LAYOUT_H

#include "src/base/precondition.h"
#include "src/kernels/batch.h"

#include <lampion/sh.h>

/* Whether a layout and a stride keep the elements apart: `values` floats each, or planes of
 * `count`. */
static inline bool lmpi_is_layout(lmp_sh_layout layout, size_t stride, size_t values,
                                  size_t count) {
    if (layout != LMP_SH_INTERLEAVED && layout != LMP_SH_PLANAR)
        return false;
    const size_t least = sizeof(float) * (layout == LMP_SH_PLANAR ? count : values);
    return stride == 0 || (stride >= least && stride % sizeof(float) == 0);
}

static inline bool lmpi_is_sh_array(lmp_sh_array array, size_t values, size_t count) {
    return lmpi_is_layout(array.layout, array.stride, values, count);
}

/* Describe a result of `values` values per element for kernels, and the same result without its
 * first elements. */
static inline lmpi_kernel_out lmpi_sh_array_all(lmp_sh_array array, size_t values, size_t count) {
    return lmpi_batch_all(array.at, values, count, array.layout == LMP_SH_PLANAR, array.stride);
}
static inline lmpi_kernel_out lmpi_sh_array_from(lmp_sh_array array, size_t values, size_t count,
                                                 size_t first) {
    const lmpi_kernel_out all = lmpi_sh_array_all(array, values, count);
    return lmpi_batch_from(&all, first);
}

/* Returns the floats from the first to past the last of a result. */
static inline size_t lmpi_layout_extent(lmp_sh_layout layout, size_t stride, size_t values,
                                        size_t count) {
    const size_t side = layout == LMP_SH_PLANAR ? count : values;
    const size_t runs = layout == LMP_SH_PLANAR ? values : count;
    return runs == 0 ? 0 : (runs - 1) * (stride ? stride / sizeof(float) : side) + side;
}

#endif
