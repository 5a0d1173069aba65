/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"

#include <lampion/sh.h>

void lmp_sh_pack_half_n(const float *values, size_t count, uint16_t *halves) {
    assert(lmpi_are_bytes_apart(values, count * sizeof *values, halves, count * sizeof *halves));
    lmpi_kernels_get()->convert.pack_half(values, count, halves);
}

void lmp_sh_unpack_half_n(const uint16_t *halves, size_t count, float *values) {
    assert(lmpi_are_bytes_apart(values, count * sizeof *values, halves, count * sizeof *halves));
    lmpi_kernels_get()->convert.unpack_half(halves, count, values);
}
