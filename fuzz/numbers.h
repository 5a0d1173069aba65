/* SPDX-License-Identifier: MIT */
/* numbers.h - for functions of numbers: takes arguments within their preconditions from the input;
 * past its end everything is 0. */
#ifndef LAMPION_FUZZ_NUMBERS_H
#define LAMPION_FUZZ_NUMBERS_H

#include <lampion/base.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct fuzz_input {
    const uint8_t *at;
    size_t left;
} fuzz_input;

static inline void fuzz_take(fuzz_input *in, void *to, size_t size) {
    const size_t taken = size < in->left ? size : in->left;
    memset(to, 0, size);
    if (taken > 0)
        memcpy(to, in->at, taken);
    in->at += taken;
    in->left -= taken;
}

/* Takes an integer in first … last, which are less than 256 apart. */
static inline int fuzz_int(fuzz_input *in, int first, int last) {
    uint8_t byte;
    fuzz_take(in, &byte, 1);
    return first + byte % (last - first + 1);
}

/* Takes any float whose magnitude is in least … most, else 0. */
static inline float fuzz_float(fuzz_input *in, float least, float most) {
    float x;
    fuzz_take(in, &x, sizeof x);
    return fabsf(x) >= least && fabsf(x) <= most ? x : 0;
}

static inline lmp_vec3 fuzz_vector(fuzz_input *in, float least, float most) {
    lmp_vec3 v;
    v.x = fuzz_float(in, least, most);
    v.y = fuzz_float(in, least, most);
    v.z = fuzz_float(in, least, most);
    return v;
}

/* Takes a direction, unit up to rounding; +z if the input gives none. */
static inline lmp_vec3 fuzz_direction(fuzz_input *in) {
    const lmp_vec3 v = fuzz_vector(in, 1e-18f, 1e18f);
    const double x = (double)v.x, y = (double)v.y, z = (double)v.z;
    const double length = sqrt(x * x + y * y + z * z);
    if (!(length > 0))
        return (lmp_vec3) { 0, 0, 1 };
    return (lmp_vec3) { (float)(x / length), (float)(y / length), (float)(z / length) };
}

/* Returns the input as text, to be freed; NULL if memory ran out. */
static inline char *fuzz_text(const uint8_t *data, size_t size) {
    char *const text = malloc(size + 1);
    if (!text)
        return NULL;
    memcpy(text, data, size);
    text[size] = '\0';
    return text;
}

/* Aborts unless a property of the results holds. */
static inline void fuzz_expect(bool holds) {
    if (!holds)
        abort();
}

#endif
