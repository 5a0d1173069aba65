/* SPDX-License-Identifier: MIT */
/* half_tmpl.h - converts floats to 16 bits and back, by the CPU's own conversions where it has
 * them, with the bits of src/base/half.h. */
#ifndef LAMPION_KERNELS_HALF_TMPL_H
#define LAMPION_KERNELS_HALF_TMPL_H

#include "src/base/half.h"
#include "src/kernels/lanes.h"

static void kernel_pack_half(const float *values, size_t count, uint16_t *halves) {
    size_t i = 0;
    for (; i + LMPI_LANES <= count; i += LMPI_LANES)
        half_pack(values + i, halves + i);
    for (; i < count; i++)
        halves[i] = lmpi_half_of_float(values[i]);
}

static void kernel_unpack_half(const uint16_t *halves, size_t count, float *values) {
    size_t i = 0;
    for (; i + LMPI_LANES <= count; i += LMPI_LANES)
        half_unpack(halves + i, values + i);
    for (; i < count; i++)
        values[i] = lmpi_float_of_half(halves[i]);
}

#endif
