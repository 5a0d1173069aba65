/* SPDX-License-Identifier: MIT */
/* half.h - numbers of 16 bits, IEEE 754's binary16, as CPUs convert them: a NaN keeps its sign and
 * the upper bits of its payload, and is quiet. */
#ifndef LAMPION_BASE_HALF_H
#define LAMPION_BASE_HALF_H

#include <stdint.h>
#include <string.h>

#define LMP_HALF_INFINITE 0x7c00u
#define LMP_HALF_QUIET    0x0200u

/* As floats: where infinity is, where it begins to be the nearest but for rounding, and the least
 * half that is normal. */
#define LMP_HALF_FLOAT_INFINITE 0x7f800000u
#define LMP_HALF_FLOAT_ABOVE    0x47800000u
#define LMP_HALF_FLOAT_NORMAL   0x38800000u

/* To the nearest, ties to even. A subnormal half is what the last digits of a sum with 1/2 are. */
static inline uint16_t lmp_half_of_float(float value) {
    uint32_t bits, half;
    memcpy(&bits, &value, sizeof bits);
    const uint32_t sign = bits >> 16 & 0x8000u, size = bits & 0x7fffffffu;
    if (size > LMP_HALF_FLOAT_INFINITE) {
        half = LMP_HALF_INFINITE | LMP_HALF_QUIET | (size >> 13 & 0x3ffu);
    } else if (size >= LMP_HALF_FLOAT_ABOVE) {
        half = LMP_HALF_INFINITE;
    } else if (size >= LMP_HALF_FLOAT_NORMAL) {
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
static inline float lmp_float_of_half(uint16_t half) {
    const uint32_t size = (half & 0x7fffu) << 13, sign = (half & 0x8000u) << 16;
    float value;
    memcpy(&value, &size, sizeof value);
    value *= 0x1p112f;
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    if ((half & 0x7fffu) >= LMP_HALF_INFINITE)
        bits |= LMP_HALF_FLOAT_INFINITE;
    if ((half & 0x7fffu) > LMP_HALF_INFINITE)
        bits |= LMP_HALF_QUIET << 13;
    bits |= sign;
    memcpy(&value, &bits, sizeof value);
    return value;
}

#endif
