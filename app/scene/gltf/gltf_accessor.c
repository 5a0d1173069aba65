/* SPDX-License-Identifier: MIT */
/* gltf_accessor.c - the numbers of an accessor, of any component type, interleaved or sparse. */
#include "app/scene/gltf/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double read_component(const unsigned char *bytes, gltf_component component) {
    const uint32_t low = bytes[0];
    if (component == GLTF_BYTE)
        return (double)(int8_t)low;
    if (component == GLTF_UNSIGNED_BYTE)
        return (double)low;
    const uint32_t pair = low | (uint32_t)bytes[1] << 8;
    if (component == GLTF_SHORT)
        return (double)(int16_t)pair;
    if (component == GLTF_UNSIGNED_SHORT)
        return (double)pair;
    const uint32_t word = pair | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
    if (component == GLTF_UNSIGNED_INT)
        return (double)word;
    float number;
    memcpy(&number, &word, sizeof number);
    return (double)number;
}

/* Returns the integer that stands for 1 in a normalized component. */
static double full_scale(gltf_component component) {
    switch (component) {
    case GLTF_BYTE:
        return 127.0;
    case GLTF_UNSIGNED_BYTE:
        return 255.0;
    case GLTF_SHORT:
        return 32767.0;
    default:
        return 65535.0;
    }
}

static size_t size_of(gltf_component component) {
    return gltf_element_size("SCALAR", component);
}

/* Reads one element. The columns of matrices have no padding here, because matrices are only read
 * as floats. */
static void read_element(const gltf_accessor *a, const unsigned char *bytes, double *out) {
    for (int k = 0; k < a->width; k++) {
        out[k] = read_component(bytes + (size_t)k * size_of(a->component), a->component);
        if (a->normalized)
            out[k] = fmax(out[k] / full_scale(a->component), -1.0);
    }
}

/* Stores an element that was read. */
typedef bool (*store)(void *to, size_t index, int width, const double *element);

/* Calls `put` for each element, and again for those that the sparse part replaces. */
static bool read_all(const gltf_accessor *a, store put, void *to) {
    double element[16] = { 0.0 };
    for (size_t i = 0; i < a->count; i++) {
        if (a->bytes)
            read_element(a, a->bytes + i * a->stride, element);
        if (!put(to, i, a->width, element))
            return false;
    }
    double before = -1.0;
    for (size_t i = 0; i < a->sparse.count; i++) {
        const size_t unit = size_of(a->sparse.component);
        const double index = read_component(a->sparse.indices + i * unit, a->sparse.component);
        if (!(index > before && index < (double)a->count))
            return false;
        before = index;
        read_element(a, a->sparse.values + i * size_of(a->component) * (size_t)a->width, element);
        if (!put(to, (size_t)index, a->width, element))
            return false;
    }
    return true;
}

static bool store_floats(void *to, size_t index, int width, const double *element) {
    float *numbers = (float *)to + index * (size_t)width;
    for (int k = 0; k < width; k++) {
        numbers[k] = (float)element[k];
        if (!isfinite(numbers[k]))
            return false;
    }
    return true;
}

bool gltf_read_floats(const gltf *document, size_t accessor, float **numbers, base_error *error) {
    const gltf_accessor *a = &document->accessors[accessor];
    *numbers = calloc(a->count * (size_t)a->width, sizeof **numbers);
    if (!*numbers)
        return base_fail(error, document->subject, "does not fit into memory");
    return read_all(a, store_floats, *numbers) ||
           gltf_fail(document, GLTF_ACCESSORS, accessor,
                     "has a number that is not finite, or sparse indices that do not rise", error);
}

typedef struct bounded {
    uint32_t *numbers;
    double limit;
} bounded;

static bool store_integers(void *to, size_t index, int width, const double *element) {
    const bounded *b = to;
    for (int k = 0; k < width; k++) {
        if (!(element[k] >= 0.0 && element[k] < b->limit))
            return false;
        b->numbers[index * (size_t)width + (size_t)k] = (uint32_t)element[k];
    }
    return true;
}

bool gltf_read_integers(const gltf *document, size_t accessor, size_t limit, uint32_t **numbers,
                        base_error *error) {
    const gltf_accessor *a = &document->accessors[accessor];
    *numbers = calloc(a->count * (size_t)a->width, sizeof **numbers);
    if (!*numbers)
        return base_fail(error, document->subject, "does not fit into memory");
    bounded to = { *numbers, (double)limit };
    return read_all(a, store_integers, &to) ||
           gltf_fail(document, GLTF_ACCESSORS, accessor,
                     "has an index past what it refers to (or sparse indices that do not rise)",
                     error);
}
