/* SPDX-License-Identifier: MIT */
/* lanes_4_wasm.h - what WebAssembly's SIMD does in its own way (lanes_4.h). */
#ifndef LAMPION_KERNELS_LANES_4_WASM_H
#define LAMPION_KERNELS_LANES_4_WASM_H

#include <wasm_simd128.h>

#define LMPI_OPAQUE_LANES(v)

/* pmax(b, a) is b < a ? a : b, and pmin likewise: b where they are equal or not numbers. */
LMPI_INLINE vf vf_sqrt(vf a) {
    return (vf)wasm_f32x4_sqrt((v128_t)a);
}
LMPI_INLINE vf vf_max(vf a, vf b) {
    return (vf)wasm_f32x4_pmax((v128_t)b, (v128_t)a);
}
LMPI_INLINE vf vf_min(vf a, vf b) {
    return (vf)wasm_f32x4_pmin((v128_t)b, (v128_t)a);
}
LMPI_INLINE int vf_any_less(vf a, vf b) {
    return wasm_v128_any_true(wasm_f32x4_lt((v128_t)a, (v128_t)b));
}
LMPI_INLINE vd vd_max(vd a, vd b) {
    return (vd)wasm_f64x2_pmax((v128_t)b, (v128_t)a);
}
LMPI_INLINE int vd_any_less(vd a, vd b) {
    return wasm_v128_any_true(wasm_f64x2_lt((v128_t)a, (v128_t)b));
}

#include "src/kernels/lanes_4_any.h"

#endif
