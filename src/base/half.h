/* SPDX-License-Identifier: MIT */
/* half.h - conversions to and from IEEE 754's binary16, as CPUs do them: a NaN keeps its sign and
 * the upper bits of its payload, and becomes quiet. */
#ifndef LAMPION_BASE_HALF_H
#define LAMPION_BASE_HALF_H

#include <stdint.h>
#include <string.h>

#define LMPI_HALF_INFINITE 0x7c00u
#define LMPI_HALF_QUIET    0x0200u

/* Bits of floats: infinity, the least float that becomes infinity once rounding is done, and the
 * least normal half. */
#define LMPI_HALF_FLOAT_INFINITE 0x7f800000u
#define LMPI_HALF_FLOAT_ABOVE    0x47800000u
#define LMPI_HALF_FLOAT_NORMAL   0x38800000u

/* Rounds to the nearest, ties to even. A subnormal half is the last digits of a sum with 1/2. */
static inline uint16_t lmpi_half_of_float(float value) {
    uint32_t bits, half;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000u, size = bits & 0x7fffffffu;
    if (size > LMPI_HALF_FLOAT_INFINITE) {
        half = LMPI_HALF_INFINITE | LMPI_HALF_QUIET | (size >> 13 & 0x3ffu);
    } else if (size >= LMPI_HALF_FLOAT_ABOVE) {
        half = LMPI_HALF_INFINITE;
    } else if (size >= LMPI_HALF_FLOAT_NORMAL) {
        half = (size - 0x38000000u + 0xfffu + (size >> 13 & 1u)) >> 13;
    } else {
        float sum;
        memcpy(&sum, &size, sizeof sum);
        sum += 0.5f;
        memcpy(&half, &sum, sizeof half);
        half -= 0x3f000000u;
    }
    return (uint16_t)(sign | half);
}

/* Infinity and NaN have the exponent that 2^112 would be short of. */
static inline float lmpi_float_of_half(uint16_t half) {
    const uint32_t size = (half & 0x7fffu) << 13, sign = (half & 0x8000u) << 16;
    float value;
    memcpy(&value, &size, sizeof value);
    value *= 0x1p112f;
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    if ((half & 0x7fffu) >= LMPI_HALF_INFINITE)
        bits |= LMPI_HALF_FLOAT_INFINITE;
    if ((half & 0x7fffu) > LMPI_HALF_INFINITE)
        bits |= LMPI_HALF_QUIET << 13;
    bits |= sign;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
