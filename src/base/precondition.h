/* SPDX-License-Identifier: MIT */
/* precondition.h - what the headers ask of callers, as predicates for assert: a build with NDEBUG
 * evaluates none of them. */
#ifndef LAMPION_BASE_PRECONDITION_H
#define LAMPION_BASE_PRECONDITION_H

#include "src/base/element.h"

#include <assert.h>
#include <math.h>

static inline bool lmp_is_bands(int bands) {
    return bands >= 1 && bands <= LMP_BANDS_MAX;
}

static inline bool lmp_is_scratch(const lmp_scratch *scratch) {
    return !scratch || scratch->size == 0 ||
           (scratch->memory && (uintptr_t)scratch->memory % LMP_SCRATCH_ALIGNMENT == 0);
}

static inline bool lmp_is_finite(lmp_vec3 v) {
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

/* To rounding, and a few steps of a caller's own. */
static inline bool lmp_is_unit(lmp_vec3 v) {
    return fabsf(v.x * v.x + v.y * v.y + v.z * v.z - 1) <= LMP_UNIT_TOLERANCE;
}

static inline bool lmp_is_unit_double(const double v[3]) {
    const double length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return fabs(length2 - 1) <= (double)LMP_UNIT_TOLERANCE;
}

/* To rounding: each row a unit vector, and the cross product of the two before it. */
static inline bool lmp_is_rotation(const float r[9]) {
    float worst = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const float *a = r + 3 * i, *b = r + 3 * ((i + 1) % 3);
            const float cross = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
            worst = fmaxf(worst, fabsf(cross - r[3 * ((i + 2) % 3) + k]));
        }
    return isfinite(r[0] + r[4] + r[8]) && worst <= LMP_UNIT_TOLERANCE;
}

static inline bool lmp_are_finite(lmp_vec3_array array, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmp_is_finite(lmp_vec3_element(&array, i)))
            return false;
    return true;
}

static inline bool lmp_are_unit(lmp_vec3_array array, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!lmp_is_unit(lmp_vec3_element(&array, i)))
            return false;
    return true;
}

/* Numbers in low … high. */
static inline bool lmp_are_within(lmp_float_array array, size_t count, float low, float high) {
    for (size_t i = 0; i < count; i++) {
        const float value = lmp_element(array.at, array.stride, i);
        if (!(value >= low && value <= high))
            return false;
    }
    return true;
}

/* Whether so many bytes, and so many floats, at `a` and at `b` have none in common. */
static inline bool lmp_are_bytes_apart(const void *a, size_t a_size, const void *b, size_t b_size) {
    const uintptr_t a_first = (uintptr_t)a, b_first = (uintptr_t)b;
    return a_first + a_size <= b_first || b_first + b_size <= a_first;
}
static inline bool lmp_are_apart(const float *a, size_t a_count, const float *b, size_t b_count) {
    return lmp_are_bytes_apart(a, a_count * sizeof *a, b, b_count * sizeof *b);
}

/* Where a function may work in place. */
static inline bool lmp_are_same_or_apart(const float *a, const float *b, size_t count) {
    return a == b || lmp_are_apart(a, count, b, count);
}

#endif
