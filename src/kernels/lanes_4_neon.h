/* SPDX-License-Identifier: MIT */
/* lanes_4_neon.h - what NEON does in its own way (lanes_4.h). */
#ifndef LAMPION_KERNELS_LANES_4_NEON_H
#define LAMPION_KERNELS_LANES_4_NEON_H

#include <arm_neon.h>

#define LMPI_OPAQUE_LANES(v) __asm__("" : "+w"(v))

LMPI_INLINE vf vf_sqrt(vf a) {
    return (vf)vsqrtq_f32((float32x4_t)a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return vf_select_less(b, a, a, b);
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return vf_select_less(a, b, a, b);
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return vmaxvq_u32(vcltq_f32((float32x4_t)a, (float32x4_t)b)) != 0;
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return vd_select_less(b, a, a, b);
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return vmaxvq_u32((uint32x4_t)vcltq_f64((float64x2_t)a, (float64x2_t)b)) != 0;
}

#include "src/kernels/lanes_4_any.h"

#endif
