/* SPDX-License-Identifier: MIT */
#include "app/scene/material_file.h"

#include "app/base/file.h"
#include "app/base/sandbox.h"
#include "app/scene/sgd_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define FILE_LIMIT ((size_t)1 << 30)
#define TEXT_LIMIT ((size_t)1 << 24)

/* --- BRDFs and tables ------------------------------------------------------------------------- */

static lmp_result read_table(const void *data, size_t size, lmp_parse_error *error,
                             material_file *file) {
    return lmp_brdf_table_read(NULL, data, size, error, &file->table);
}

static lmp_result read_rgl(const void *data, size_t size, lmp_parse_error *error,
                           material_file *file) {
    return lmp_brdf_read_rgl(NULL, data, size, error, &file->brdf);
}

static lmp_result read_merl(const void *data, size_t size, lmp_parse_error *error,
                            material_file *file) {
    return lmp_brdf_read_merl(NULL, data, size, error, &file->brdf);
}

/* A file format, recognized by its first bytes; MERL files have none of their own. */
typedef struct material_format {
    const char *magic;
    lmp_result (*read)(const void *data, size_t size, lmp_parse_error *error, material_file *file);
} material_format;
static const material_format formats[] = { { "LMPT", read_table },
                                           { "tensor_file", read_rgl },
                                           { "", read_merl } };

typedef struct reading {
    const char *path, *name; /* name: of the row in a table of fits */
    void *data;
    size_t size;
    const material_format *format;
} reading;

static bool read_bytes(const reading *r, material_file *file, base_error *error) {
    lmp_parse_error parse_error = { 0 };
    return r->format->read(r->data, r->size, &parse_error, file) == LMP_OK ||
           base_fail(error, r->path, "%s (byte %zu)", parse_error.text, parse_error.offset);
}

static bool try_in_child(void *context, int output, base_error *error) {
    material_file file = { .brdf = NULL };
    return read_bytes(context, &file, error) && write(output, "", 1) == 1;
}

/* Runs the child; *block is its output, to be released with munmap. */
static bool run_child(reading *r, bool (*work)(void *context, int output, base_error *error),
                      void **block, size_t *size, base_error *error) {
    const sandbox_job job = {
        .subject = r->path, .input_bytes = r->size, .context = r, .work = work
    };
    return sandbox_run(&job, block, size, error);
}

bool material_read_file(const char *path, material_file *file, base_error *error) {
    *file = (material_file) { .brdf = NULL };
    reading r = { .path = path, .format = formats };
    void *block;
    size_t size;
    if (!file_read(path, FILE_LIMIT, &r.data, &r.size, error))
        return false;
    while (r.size < strlen(r.format->magic) ||
           memcmp(r.data, r.format->magic, strlen(r.format->magic)) != 0)
        r.format++;
    bool ok = run_child(&r, try_in_child, &block, &size, error);
    if (ok) {
        munmap(block, size);
        ok = read_bytes(&r, file, error);
    }
    file_hash_add(&file->hash, r.data, r.size);
    file->size = r.size;
    free(r.data);
    return ok;
}

/* --- tables of fits --------------------------------------------------------------------------- */

static bool find_in_child(void *context, int output, base_error *error) {
    const reading *const r = context;
    lmp_sgd sgd;
    return sgd_file_find(r->data, r->name, r->path, &sgd, error) &&
           write(output, &sgd, sizeof sgd) == (ssize_t)sizeof sgd;
}

/* Reads the parameters from the block, which holds nothing but numbers. */
static bool take_sgd(const void *block, size_t size, lmp_sgd *sgd) {
    if (size != sizeof *sgd)
        return false;
    memcpy(sgd, block, sizeof *sgd);
    const double *const numbers = sgd->rho_d;
    for (size_t i = 0; i < sizeof *sgd / sizeof *numbers; i++)
        if (!isfinite(numbers[i]))
            return false;
    return true;
}

bool material_read_sgd(const char *path, const char *name, lmp_sgd *sgd, base_error *error) {
    reading r = { .path = path, .name = name };
    void *block;
    size_t size;
    if (!file_read(path, TEXT_LIMIT, &r.data, &r.size, error))
        return false;
    bool ok = run_child(&r, find_in_child, &block, &size, error);
    if (ok) {
        ok = take_sgd(block, size, sgd) || base_fail(error, path, "is damaged");
        munmap(block, size);
    }
    free(r.data);
    return ok;
}
