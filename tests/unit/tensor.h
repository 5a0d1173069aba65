/* SPDX-License-Identifier: MIT */
/* tensor.h - RGL tensor files made by hand. */
#ifndef LAMPION_TENSOR_H
#define LAMPION_TENSOR_H

#include "src/base/bytes.h"
#include "tests/oracle/check.h"

#include <lampion/brdf.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { U8 = 1, F32 = 10, FIELDS_MAX = 12 };

/* One array of a tensor file. */
typedef struct field {
    const char *name;
    unsigned type, dimensions;
    uint64_t shape[5];
    float *values; /* owned; a U8 field holds its bytes as floats */
} field;

typedef struct tensor {
    int count;
    field fields[FIELDS_MAX];
} tensor;

static inline size_t field_count(const field *f) {
    size_t count = 1;
    for (unsigned d = 0; d < f->dimensions; d++)
        count *= (size_t)f->shape[d];
    return count;
}

/* Adds a field of `value` everywhere. */
static inline field *add(tensor *t, const char *name, unsigned type, unsigned dimensions,
                         const uint64_t *shape, float value) {
    field *f = &t->fields[t->count++];
    *f = (field) { .name = name, .type = type, .dimensions = dimensions };
    memcpy(f->shape, shape, dimensions * sizeof *shape);
    f->values = malloc(field_count(f) * sizeof *f->values);
    assert_non_null(f->values);
    for (size_t i = 0; i < field_count(f); i++)
        f->values[i] = value;
    return f;
}
#define SHAPE(...)                                                                                 \
    sizeof((uint64_t[]) { __VA_ARGS__ }) / sizeof(uint64_t), (const uint64_t[]) {                  \
        __VA_ARGS__                                                                                \
    }

static inline field *find(tensor *t, const char *name) {
    for (int i = 0; i < t->count; i++)
        if (strcmp(t->fields[i].name, name) == 0)
            return &t->fields[i];
    fail_msg("no field '%s'", name);
    return NULL;
}

/* Makes an isotropic file without samples, whose remapping is the identity and whose model is 1 /
 * 4. */
static inline tensor flat(void) {
    tensor t = { 0 };
    add(&t, "theta_i", F32, SHAPE(2), 0)->values[1] = 1.5f;
    add(&t, "phi_i", F32, SHAPE(1), 0);
    add(&t, "ndf", F32, SHAPE(2, 2), 1);
    add(&t, "sigma", F32, SHAPE(2, 2), 1);
    add(&t, "vndf", F32, SHAPE(1, 2, 2, 2), 1);
    add(&t, "jacobian", U8, SHAPE(1), 1);
    return t;
}

static inline tensor flat_rgb(void) {
    tensor t = flat();
    field *rgb = add(&t, "rgb", F32, SHAPE(1, 2, 3, 2, 2), 0);
    for (size_t i = 0; i < field_count(rgb); i++)
        rgb->values[i] = (float)(i / 4 % 3 + 1);
    return t;
}

/* Makes a file of `count` wavelengths in nm, whose spectrum is the same everywhere. */
static inline tensor flat_spectral(size_t count, const float *nm, const float *spectrum) {
    tensor t = flat();
    memcpy(add(&t, "wavelengths", F32, SHAPE(count), 0)->values, nm, count * sizeof *nm);
    field *spectra = add(&t, "spectra", F32, SHAPE(1, 2, count, 2, 2), 0);
    for (size_t i = 0; i < field_count(spectra); i++)
        spectra->values[i] = spectrum[i / 4 % count];
    return t;
}

static inline void drop(tensor *t) {
    for (int i = 0; i < t->count; i++)
        free(t->fields[i].values);
    t->count = 0;
}

static inline size_t directory_size(const tensor *t) {
    size_t size = 18;
    for (int i = 0; i < t->count; i++)
        size += 13 + strlen(t->fields[i].name) + 8 * t->fields[i].dimensions;
    return size;
}

/* Returns the bytes of a file, in a block of exactly their size. */
static inline unsigned char *bytes_of(const tensor *t, size_t *size) {
    size_t at = directory_size(t);
    *size = at;
    for (int i = 0; i < t->count; i++)
        *size += field_count(&t->fields[i]) * (t->fields[i].type == U8 ? 1 : 4);
    unsigned char *bytes = malloc(*size), *p = bytes;
    assert_non_null(bytes);
    memcpy(p, "tensor_file\0\1", 14); /* version 1.0 */
    p = lmpi_bytes_store_u32(p + 14, (uint32_t)t->count);
    for (int i = 0; i < t->count; i++) {
        const field *f = &t->fields[i];
        p = lmpi_bytes_store_u16(p, (uint16_t)strlen(f->name));
        memcpy(p, f->name, strlen(f->name));
        p = lmpi_bytes_store_u16(p + strlen(f->name), (uint16_t)f->dimensions);
        *p++ = (unsigned char)f->type;
        p = lmpi_bytes_store_u64(p, at);
        for (unsigned d = 0; d < f->dimensions; d++)
            p = lmpi_bytes_store_u64(p, f->shape[d]);
        for (size_t k = 0; k < field_count(f); k++)
            if (f->type == U8)
                bytes[at++] = (unsigned char)f->values[k];
            else {
                lmpi_bytes_store_f32(bytes + at, f->values[k]);
                at += 4;
            }
    }
    return bytes;
}

static inline lmp_brdf *read_bytes(const unsigned char *bytes, size_t size) {
    lmp_brdf *brdf = NULL;
    lmp_parse_error error = { 0 };
    if (lmp_brdf_read_rgl(NULL, bytes, size, &error, &brdf) != LMP_OK)
        fail_msg("%s", error.text);
    return brdf;
}

/* Reads a tensor, and frees it. */
static inline lmp_brdf *opened(tensor t) {
    size_t size = 0;
    unsigned char *bytes = bytes_of(&t, &size);
    drop(&t);
    lmp_brdf *brdf = read_bytes(bytes, size);
    free(bytes);
    return brdf;
}

static inline void random_pair(double a[3], double b[3]) {
    const lmp_vec3 u = check_random_direction(), v = check_random_direction();
    for (int k = 0; k < 3; k++) {
        a[k] = (double)(&u.x)[k];
        b[k] = (double)(&v.x)[k];
    }
    a[2] = fmax(fabs(a[2]), 0.05);
    b[2] = fmax(fabs(b[2]), 0.05);
    const double scale = 1 / sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
    for (int k = 0; k < 3; k++)
        b[k] *= scale;
}

#endif
