/* SPDX-License-Identifier: MIT */
/* element.h - numbers at a stride in bytes (lampion/base.h), one at a time. */
#ifndef LAMPION_BASE_ELEMENT_H
#define LAMPION_BASE_ELEMENT_H

#include <lampion/base.h>

static inline float lmpi_element(const float *first, size_t stride, size_t i) {
    return *(const float *)(const void *)((const char *)first + i * stride);
}

static inline lmp_vec3 lmpi_vec3_element(const lmp_vec3_array *array, size_t i) {
    return (lmp_vec3) { lmpi_element(array->x, array->stride, i),
                        lmpi_element(array->y, array->stride, i),
                        lmpi_element(array->z, array->stride, i) };
}

#endif
