/* SPDX-License-Identifier: MIT */
/* volume.h - reads the files of lampion field without the program's code: by jansson, as lines of
 * CSV and by NumPy's specification. */
#ifndef LAMPION_TESTS_PROGRAM_VOLUME_H
#define LAMPION_TESTS_PROGRAM_VOLUME_H

#include "tests/program/folder.h"

#include <jansson.h>
#include <math.h>

enum { NX = 4, NY = 3, NZ = 5, PROBES = NX * NY * NZ, VALUES_MAX = 75 };
#define GRID "--grid 4x3x5 --minimum -2,0,-1 --maximum 1,1.5,3 "

/* The probes of a file, one after the other, whatever its format. */
typedef struct probes {
    double position[PROBES][3];
    float values[PROBES][VALUES_MAX];
    int value_count;
} probes;

static inline char *read_text(const char *name, size_t *size) {
    static char bytes[1 << 20];
    FILE *file = fopen(in_folder(name), "rb");
    assert_non_null(file);
    *size = fread(bytes, 1, sizeof bytes - 1, file);
    assert_true(*size < sizeof bytes - 1 && !ferror(file));
    bytes[*size] = 0;
    fclose(file);
    return bytes;
}

static inline double number_at(json_t *array, int i) {
    json_t *item = json_array_get(array, (size_t)i);
    assert_true(json_is_number(item));
    return json_number_value(item);
}

static inline const char *text_of(json_t *root, const char *name) {
    json_t *item = json_object_get(root, name);
    assert_true(json_is_string(item));
    return json_string_value(item);
}

static inline void read_json_grid(json_t *root, probes *p) {
    json_t *counts = json_object_get(root, "counts");
    json_t *origin = json_object_get(root, "origin");
    json_t *steps = json_object_get(root, "steps");
    const int expected[3] = { NX, NY, NZ };
    for (int a = 0; a < 3; a++)
        assert_int_equal((int)number_at(counts, a), expected[a]);
    for (int i = 0; i < PROBES; i++) {
        const int node[3] = { i % NX, i / NX % NY, i / NX / NY };
        for (int k = 0; k < 3; k++) {
            p->position[i][k] = number_at(origin, k);
            for (int a = 0; a < 3; a++)
                p->position[i][k] += node[a] * number_at(json_array_get(steps, (size_t)a), k);
        }
    }
}

/* Reads JSON by the schema in docs/formats.md. */
static inline void read_json(const char *name, const char *preset, probes *p) {
    size_t size;
    json_t *root = json_loads(read_text(name, &size), 0, NULL);
    assert_non_null(root);
    assert_string_equal(text_of(root, "format"), "lampion-probes");
    assert_string_equal(text_of(root, "preset"), preset);
    assert_int_equal((int)json_number_value(json_object_get(root, "version")), 1);
    const bool planar = strcmp(text_of(root, "layout"), "planar") == 0;
    json_t *values = json_object_get(root, "values");
    p->value_count = (int)json_array_size(json_object_get(root, "names"));
    assert_true(p->value_count > 0 && p->value_count <= VALUES_MAX);
    assert_int_equal(json_array_size(values), PROBES * p->value_count);
    read_json_grid(root, p);
    for (int at = 0; at < PROBES * p->value_count; at++)
        if (planar)
            p->values[at % PROBES][at / PROBES] = (float)number_at(values, at);
        else
            p->values[at / p->value_count][at % p->value_count] = (float)number_at(values, at);
    json_decref(root);
}

static inline void read_csv(const char *name, probes *p) {
    size_t size;
    char *line = strtok(read_text(name, &size), "\n");
    assert_memory_equal(line, "x,y,z,r0,", 9);
    p->value_count = -2;
    for (const char *c = line; *c; c++)
        p->value_count += *c == ',';
    for (int i = 0; i < PROBES; i++) {
        char *at = strtok(NULL, "\n");
        assert_non_null(at);
        for (int k = 0; k < 3 + p->value_count; k++) {
            const double value = strtod(at, &at);
            if (k < 3)
                p->position[i][k] = value;
            else
                p->values[i][k - 3] = (float)value;
            at += *at == ',';
        }
        assert_int_equal(*at, 0);
    }
    assert_null(strtok(NULL, "\n"));
}

/* Converts an IEEE 754 binary16. */
static inline float half_value(const unsigned char *at) {
    const int bits = at[0] | at[1] << 8, exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const double size =
        exponent == 0 ? ldexp(mantissa, -24) : ldexp(1024 + mantissa, exponent - 25);
    return (float)(bits & 0x8000 ? -size : size);
}

/* Reads NumPy's format, version 1.0: 6 bytes, 2 of the version, the length of a line, the line. */
static inline void read_npy(const char *name, bool half, bool planar, probes *p) {
    size_t size;
    const unsigned char *bytes = (const unsigned char *)read_text(name, &size);
    assert_memory_equal(bytes, "\x93NUMPY\1\0", 8);
    const size_t begin = 10 + bytes[8] + 256u * bytes[9], width = half ? 2 : 4;
    char expected[128];
    snprintf(expected, sizeof expected,
             planar ? "{'descr': '<f%zu', 'fortran_order': False, 'shape': (27, 5, 3, 4), }"
                    : "{'descr': '<f%zu', 'fortran_order': False, 'shape': (5, 3, 4, 27), }",
             width);
    assert_int_equal(begin % 64, 0);
    assert_int_equal(bytes[begin - 1], '\n');
    assert_memory_equal(bytes + 10, expected, strlen(expected));
    assert_int_equal(size, begin + width * PROBES * 27);
    for (size_t i = 0; i < PROBES * 27; i++) {
        const unsigned char *at = bytes + begin + width * i;
        float *to = planar ? &p->values[i % PROBES][i / PROBES] : &p->values[i / 27][i % 27];
        if (half)
            *to = half_value(at);
        else
            memcpy(to, at, sizeof *to);
    }
    p->value_count = 27;
}

#endif
