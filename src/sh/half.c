/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/kernels.h"

#include <lampion/sh.h>

void lmp_sh_pack_half(const float *values, size_t count, uint16_t *halves) {
    assert(lmp_are_bytes_apart(values, count * sizeof *values, halves, count * sizeof *halves));
    lmp_kernels_get()->pack_half(values, count, halves);
}

void lmp_sh_unpack_half(const uint16_t *halves, size_t count, float *values) {
    assert(lmp_are_bytes_apart(values, count * sizeof *values, halves, count * sizeof *halves));
    lmp_kernels_get()->unpack_half(halves, count, values);
}
