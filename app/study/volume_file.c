/* SPDX-License-Identifier: MIT */
/* volume_file.c - writes a volume as JSON, CSV and NPY (docs/formats.md). */
#include "app/base/csv.h"
#include "app/base/file_writer.h"
#include "app/scene/world.h"
#include "app/study/volume.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *const volume_layouts[] = { "interleaved", "planar", NULL };

volume_file volume_file_of(const char *path) {
    static const char *const endings[] = { ".json", ".csv", ".npy", ".lmpf" };
    const char *ending = strrchr(path, '.');
    for (int i = 0; ending && i < VOLUME_UNKNOWN; i++)
        if (strcmp(ending, endings[i]) == 0)
            return (volume_file)i;
    return VOLUME_UNKNOWN;
}

/* --- 16 bits ---------------------------------------------------------------------------------- */

#define HALF_MAX 65504.0f

/* Converts a number to a half, infinite past HALF_MAX. */
static uint16_t half_bits(float value) {
    uint16_t half;
    lmp_sh_pack_half_n(&value, 1, &half);
    return half;
}

static float round_to_half(float value) {
    const uint16_t half = half_bits(value);
    lmp_sh_unpack_half_n(&half, 1, &value);
    return value;
}

/* --- values ----------------------------------------------------------------------------------- */

/* The state of writing a volume. */
typedef struct volume_text {
    const volume *volume;
    const volume_output *output;
    FILE *stream;
} volume_text;

static float value_of(const volume_text *t, size_t probe, size_t i) {
    const float value = t->volume->values[probe * t->volume->value_count + i];
    return t->output->half ? round_to_half(value) : value;
}

static bool fail_too_bright(const char *path, base_error *error) {
    return base_fail(error, path, "cannot hold the light: its values are not finite");
}

static bool fits(const volume *v, const volume_output *output, base_error *error) {
    for (size_t i = 0; i < v->probe_count * v->value_count; i++) {
        if (!isfinite(v->values[i]))
            return fail_too_bright(output->path, error);
        if (output->half && !(fabsf(round_to_half(v->values[i])) <= HALF_MAX))
            return base_fail(error, NULL, "%g does not fit into 16 bits (--half holds up to %g)",
                             (double)v->values[i], (double)HALF_MAX);
    }
    return true;
}

static void put_number(FILE *stream, float value) {
    char text[CSV_TEXT_MAX];
    fwrite(text, 1, csv_format(value, text), stream);
}

static void put_numbers(FILE *stream, const float *values, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (i > 0)
            fputs(", ", stream);
        put_number(stream, values[i]);
    }
}

static void put_coordinate(FILE *stream, double origin, float relative) {
    scene_world_text text;
    if (origin == 0.0) {
        put_number(stream, relative);
        return;
    }
    scene_print_world(origin, relative, 9, text);
    fputs(text, stream);
}

/* Calls `put` for every value in the file's order, in rows: of a probe, or of a value. */
typedef void put_value(const volume_text *text, float value, size_t row, size_t column);
static void each_value(const volume_text *t, put_value *put) {
    const bool planar = t->output->layout == VOLUME_PLANAR;
    const size_t rows = planar ? t->volume->value_count : t->volume->probe_count;
    const size_t columns = planar ? t->volume->probe_count : t->volume->value_count;
    for (size_t row = 0; row < rows; row++)
        for (size_t column = 0; column < columns; column++)
            put(t, planar ? value_of(t, column, row) : value_of(t, row, column), row, column);
}

/* --- JSON ------------------------------------------------------------------------------------- */

static void put_json_value(const volume_text *t, float value, size_t row, size_t column) {
    fputs(column > 0 ? ", " : row > 0 ? ",\n    " : "\n    ", t->stream);
    put_number(t->stream, value);
}

static void put_json_names(const volume_text *t) {
    fputs("  \"names\": [", t->stream);
    for (size_t i = 0; i < t->volume->value_count; i++) {
        volume_name name;
        volume_name_value(t->volume, i, name);
        fprintf(t->stream, "%s\"%s\"", i > 0 ? ", " : "", name);
    }
    fputs("],\n", t->stream);
}

static void put_json_grid(const volume_text *t) {
    const volume *v = t->volume;
    const int *counts = v->settings.grid.counts;
    float first[3], step[3];
    volume_position(v, (int[3]) { 0 }, first);
    fprintf(t->stream, "  \"counts\": [%d, %d, %d],\n  \"origin\": [", counts[0], counts[1],
            counts[2]);
    for (int a = 0; a < 3; a++) {
        fputs(a > 0 ? ", " : "", t->stream);
        put_coordinate(t->stream, v->origin[a], first[a]);
    }
    fputs("],\n  \"steps\": [", t->stream);
    for (int a = 0; a < 3; a++) {
        volume_step(v, a, step);
        fputs(a > 0 ? ", [" : "[", t->stream);
        put_numbers(t->stream, step, 3);
        putc(']', t->stream);
    }
    fputs("],\n", t->stream);
}

static void put_json(const volume_text *t) {
    const volume *v = t->volume;
    fprintf(t->stream,
            "{\n  \"format\": \"lampion-probes\",\n  \"version\": 1,\n  \"preset\": \"%s\",\n"
            "  \"bands\": %d,\n",
            v->format->name, v->settings.bands);
    put_json_grid(t);
    put_json_names(t);
    fprintf(t->stream, "  \"layout\": \"%s\",\n  \"precision\": \"%s\",\n  \"values\": [",
            volume_layouts[t->output->layout], t->output->half ? "half" : "float");
    each_value(t, put_json_value);
    fputs("\n  ]\n}\n", t->stream);
}

/* --- CSV -------------------------------------------------------------------------------------- */

static void put_csv(const volume_text *t) {
    const volume *v = t->volume;
    fputs("x,y,z", t->stream);
    for (size_t i = 0; i < v->value_count; i++) {
        volume_name name;
        volume_name_value(v, i, name);
        fprintf(t->stream, ",%s", name);
    }
    for (size_t probe = 0; probe < v->probe_count; probe++) {
        int node[3];
        float at[3];
        volume_node(v, probe, node);
        volume_position(v, node, at);
        for (int a = 0; a < 3; a++) {
            putc(a == 0 ? '\n' : ',', t->stream);
            put_coordinate(t->stream, v->origin[a], at[a]);
        }
        for (size_t k = 0; k < v->value_count; k++) {
            putc(',', t->stream);
            put_number(t->stream, value_of(t, probe, k));
        }
    }
    putc('\n', t->stream);
}

/* --- NPY -------------------------------------------------------------------------------------- */

static void put_bytes(FILE *stream, uint32_t bits, int count) {
    for (int i = 0; i < count; i++)
        putc((int)(bits >> 8 * i & 0xff), stream);
}

static void put_npy_value(const volume_text *t, float value, size_t row, size_t column) {
    uint32_t bits;
    (void)row;
    (void)column;
    memcpy(&bits, &value, sizeof bits);
    if (t->output->half)
        put_bytes(t->stream, half_bits(value), 2);
    else
        put_bytes(t->stream, bits, 4);
}

/* Writes version 1.0 of NumPy's format: a line of Python that ends at a multiple of 64 bytes. */
static void put_npy(const volume_text *t) {
    enum { BEFORE = 10, LINE = 182 }; /* 192 bytes in all */
    const int *counts = t->volume->settings.grid.counts;
    const size_t values = t->volume->value_count;
    char shape[64], line[LINE + 1];
    if (t->output->layout == VOLUME_PLANAR)
        snprintf(shape, sizeof shape, "%zu, %d, %d, %d", values, counts[2], counts[1], counts[0]);
    else
        snprintf(shape, sizeof shape, "%d, %d, %d, %zu", counts[2], counts[1], counts[0], values);
    snprintf(line, sizeof line, "{'descr': '%s', 'fortran_order': False, 'shape': (%s), }",
             t->output->half ? "<f2" : "<f4", shape);
    fwrite("\x93NUMPY\1", 1, BEFORE - 2, t->stream);
    put_bytes(t->stream, LINE, 2);
    fprintf(t->stream, "%-*s\n", LINE - 1, line);
    each_value(t, put_npy_value);
}

/* --- files ------------------------------------------------------------------------------------ */

bool volume_write(const volume *v, const volume_output *output, base_error *error) {
    file_writer writer;
    if (!fits(v, output, error) || !file_write_begin(&writer, output->path, error))
        return false;
    const volume_text text = { v, output, writer.stream };
    switch (volume_file_of(output->path)) {
    case VOLUME_CSV:
        put_csv(&text);
        break;
    case VOLUME_NPY:
        put_npy(&text);
        break;
    default:
        put_json(&text);
    }
    return file_write_commit(&writer, error);
}

bool volume_write_field(const lmp_field *field, const char *path, base_error *error) {
    const size_t size = lmp_field_size(field);
    void *bytes = malloc(size);
    if (!bytes)
        return base_fail(error, path, "out of memory");
    lmp_field_write(field, size, bytes);
    /* a field that cannot be read back is not written */
    lmp_field *back = NULL;
    const lmp_result result = lmp_field_read(NULL, bytes, size, NULL, &back);
    lmp_field_destroy(back);
    const bool ok = result == LMP_OK             ? file_write_whole(path, bytes, size, error)
                    : result == LMP_ERROR_MEMORY ? base_fail(error, path, "out of memory")
                                                 : fail_too_bright(path, error);
    free(bytes);
    return ok;
}
