/* SPDX-License-Identifier: MIT */
/* precondition.h - what the headers ask of callers, as predicates for assert: a build with NDEBUG
 * evaluates none of them. */
#ifndef LAMPION_BASE_PRECONDITION_H
#define LAMPION_BASE_PRECONDITION_H

#include "src/base/element.h"

#include <assert.h>
#include <math.h>

static inline bool lmpi_is_bands(int bands) {
    return bands >= 1 && bands <= LMP_BANDS_MAX;
}

static inline bool lmpi_is_scratch(const lmp_scratch *scratch) {
    return !scratch || scratch->size == 0 ||
           (scratch->memory && (uintptr_t)scratch->memory % LMP_SCRATCH_ALIGNMENT == 0);
}

static inline bool lmpi_is_finite(lmp_vec3 v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

/* Whether v is unit up to rounding and a few steps of the caller's own arithmetic. */
static inline bool lmpi_is_unit(lmp_vec3 v) {
    return fabsf(v.x * v.x + v.y * v.y + v.z * v.z - 1) <= LMP_UNIT_TOLERANCE;
}

static inline bool lmpi_is_unit_double(const double v[3]) {
    const double length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return fabs(length2 - 1) <= (double)LMP_UNIT_TOLERANCE;
}

/* Whether r is a rotation up to rounding: each row is unit, and the cross product of the two before
 * it. */
static inline bool lmpi_is_rotation(const float r[9]) {
    float worst = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const float *a = r + 3 * i, *b = r + 3 * ((i + 1) % 3);
            const float cross = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
            worst = fmaxf(worst, fabsf(cross - r[3 * ((i + 2) % 3) + k]));
        }
    return isfinite(r[0] + r[4] + r[8]) && worst <= LMP_UNIT_TOLERANCE;
}

static inline bool lmpi_are_finite(lmp_vec3_array array, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmpi_is_finite(lmpi_vec3_element(&array, i)))
            return false;
    return true;
}

static inline bool lmpi_are_unit(lmp_vec3_array array, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmpi_is_unit(lmpi_vec3_element(&array, i)))
            return false;
    return true;
}

/* Whether all numbers lie in low … high. */
static inline bool lmpi_are_within(lmp_float_array array, size_t count, float low, float high) {
    for (size_t i = 0; i < count; i++) {
        const float value = lmpi_element(array.at, array.stride, i);
        if (!(value >= low && value <= high))
            return false;
    }
    return true;
}

/* Whether two ranges of memory, given in bytes or in floats, do not overlap. */
static inline bool lmpi_are_bytes_apart(const void *a, size_t a_size, const void *b,
                                        size_t b_size) {
    const uintptr_t a_first = (uintptr_t)a, b_first = (uintptr_t)b;
    return a_first + a_size <= b_first || b_first + b_size <= a_first;
}
static inline bool lmpi_are_apart(const float *a, size_t a_count, const float *b, size_t b_count) {
    return lmpi_are_bytes_apart(a, a_count * sizeof *a, b, b_count * sizeof *b);
}

/* Whether two arrays are the same or do not overlap, for functions that may work in place. */
static inline bool lmpi_are_same_or_apart(const float *a, const float *b, size_t count) {
    return a == b || lmpi_are_apart(a, count, b, count);
}

/* Whether colors keep apart. */
static inline bool lmpi_is_rgb_array(lmp_rgb_array rgb) {
    return rgb.stride == 0 || (rgb.stride >= sizeof(lmp_rgb) && rgb.stride % sizeof(float) == 0);
}

#endif
