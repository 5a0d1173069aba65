/* SPDX-License-Identifier: MIT */
/* layout.h - what a caller's layout and stride (lampion/sh.h) must hold to, and how far it reaches.
 */
#ifndef LAMPION_SH_LAYOUT_H
#define LAMPION_SH_LAYOUT_H

#include "src/base/precondition.h"

#include <lampion/sh.h>

/* A layout and a stride that keep the elements apart: `values` floats each, or `count` a plane. */
static inline bool lmp_is_layout(lmp_sh_layout layout, size_t stride, size_t values, size_t count) {
    if (layout != LMP_SH_INTERLEAVED && layout != LMP_SH_PLANAR)
        return false;
    const size_t least = sizeof(float) * (layout == LMP_SH_PLANAR ? count : values);
    return stride == 0 || (stride >= least && stride % sizeof(float) == 0);
}

/* The floats from the first to past the last of such a result. */
static inline size_t lmp_layout_extent(lmp_sh_layout layout, size_t stride, size_t values,
                                       size_t count) {
    const size_t side = layout == LMP_SH_PLANAR ? count : values;
    const size_t runs = layout == LMP_SH_PLANAR ? values : count;
    return runs == 0 ? 0 : (runs - 1) * (stride ? stride / sizeof(float) : side) + side;
}

#endif
