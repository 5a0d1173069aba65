/* SPDX-License-Identifier: MIT */
/* The tables that shading reads of a material: its BRDF's, and that preintegrated. */
#define _DEFAULT_SOURCE /* madvise */
#include "app/base/file_writer.h"
#include "app/scene/bake.h"
#include "app/scene/material.h"

#include <stdlib.h>
#include <sys/mman.h>

/* --- tables ----------------------------------------------------------------------------------- */

typedef struct table_recipe {
    const lmp_brdf *brdf;
    const lmp_brdf_table_desc *desc;
} table_recipe;

static void *read_table(const void *bytes, size_t size, const void *user) {
    (void)user;
    lmp_brdf_table *table;
    lmp_brdf_table_read(NULL, bytes, size, NULL, &table);
    return table;
}

static lmp_result make_table(const lmp_host *host, const void *user, void **object) {
    const table_recipe *from = user;
    lmp_brdf_table *table;
    const lmp_result result = lmp_brdf_table_create(host, from->desc, from->brdf, &table);
    *object = table;
    return result;
}

static size_t size_of_table(const void *table) {
    return lmp_brdf_table_size(table);
}

static void write_table(const void *table, void *bytes) {
    lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes);
}

/* Returns the bytes of a table file, to be freed, or NULL if memory ran out. */
static void *bytes_of(const lmp_brdf_table *table, size_t *size) {
    *size = lmp_brdf_table_size(table);
    void *bytes = malloc(*size);
    if (bytes)
        lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes);
    return bytes;
}

static bool copy_table(const lmp_brdf_table *from, lmp_brdf_table **table, base_error *error) {
    size_t size;
    void *const bytes = bytes_of(from, &size);
    if (!bytes)
        return base_fail(error, NULL, "out of memory");
    const lmp_result result = lmp_brdf_table_read(NULL, bytes, size, NULL, table);
    free(bytes);
    return result == LMP_OK || base_fail(error, NULL, "%s", lmp_result_text(result));
}

lmp_brdf_table_info material_plan(const material *m, const lmp_brdf_table_desc *desc) {
    if (m->table)
        return lmp_brdf_table_describe(m->table);
    const bool turns = lmp_brdf_describe(m->brdf).anisotropic;
    return (lmp_brdf_table_info) { .bands = desc->bands,
                                   .azimuths = turns ? desc->azimuths : 1,
                                   .mirrored = !turns };
}

bool material_bake(const material *m, const lmp_brdf_table_desc *desc, lmp_brdf_table **table,
                   base_error *error) {
    const table_recipe from = { m->brdf, desc };
    bake_recipe recipe = { .kind = "lmpt",
                           .what = "projecting the BRDF",
                           .key = m->hash,
                           .read = read_table,
                           .make = make_table,
                           .size = size_of_table,
                           .write = write_table,
                           .user = &from };
    const struct {
        int32_t numbers[6];
        float reals[2];
    } settings = { { desc->bands, desc->views, desc->azimuths, (int)desc->window,
                     (int)desc->symmetry, desc->rings_max },
                   { desc->window_size, desc->tolerance } };
    *table = NULL;
    if (m->table)
        return copy_table(m->table, table, error);
    bake_add_settings(&recipe.key, &settings, sizeof settings);
    void *object;
    const lmp_result result = bake(&recipe, &object);
    *table = object;
    return result == LMP_OK || base_fail(error, m->name, "%s", lmp_result_text(result));
}

bool material_write_table(const lmp_brdf_table *table, const char *path, base_error *error) {
    size_t size;
    void *const bytes = bytes_of(table, &size);
    if (!bytes)
        return base_fail(error, path, "out of memory");
    const bool ok = file_write_whole(path, bytes, size, error);
    free(bytes);
    return ok;
}

/* --- preintegrated ---------------------------------------------------------------------------- */

/* Allocates large pages where the system has them: fresh pages cost more than the bytes in them. */
static void *allocate_large(size_t size, void *user) {
    (void)user;
    const size_t page = (size_t)1 << 21, whole = (size + page - 1) / page * page;
    void *memory = size < page ? malloc(size) : aligned_alloc(page, whole);
    if (memory && size >= page)
        madvise(memory, whole, MADV_HUGEPAGE);
    return memory;
}

static void release_large(void *memory, void *user) {
    (void)user;
    free(memory);
}

static void *read_preintegrated(const void *bytes, size_t size, const void *user) {
    static const lmp_host large = { .allocate = allocate_large, .release = release_large };
    (void)user;
    lmp_preintegrated_brdf *brdf;
    lmp_preintegrated_brdf_read(&large, bytes, size, NULL, &brdf);
    return brdf;
}

static lmp_result make_preintegrated(const lmp_host *host, const void *user, void **object) {
    lmp_preintegrated_brdf *brdf;
    const lmp_result result = lmp_preintegrated_brdf_create(host, NULL, user, &brdf);
    *object = brdf;
    return result;
}

static size_t size_of_preintegrated(const void *brdf) {
    return lmp_preintegrated_brdf_size(brdf);
}

static void write_preintegrated(const void *brdf, void *bytes) {
    lmp_preintegrated_brdf_write(brdf, lmp_preintegrated_brdf_size(brdf), bytes);
}

/* Says why a material is evaluated by its bands; returns true, because that is not a failure. */
static bool note_without(const material *m, const char *why) {
    base_note(m->name, "%s: shaded by its bands (as by --method coefficients)", why);
    return true;
}

bool material_preintegrate(const material *m, const lmp_brdf_table *table,
                           lmp_preintegrated_brdf **brdf, base_error *error) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const struct {
        int32_t bands, window;
        float window_size;
    } settings = { info.bands, (int32_t)info.window, info.window_size };
    bake_recipe recipe = { .kind = "lmps",
                           .what = "integrating the BRDF",
                           .key = m->hash,
                           .read = read_preintegrated,
                           .make = make_preintegrated,
                           .size = size_of_preintegrated,
                           .write = write_preintegrated,
                           .user = table };
    *brdf = NULL;
    if (info.azimuths > 1)
        return note_without(m, "an anisotropic material would take gigabytes");
    bake_add_settings(&recipe.key, &settings, sizeof settings);
    void *object;
    const lmp_result result = bake(&recipe, &object);
    *brdf = object;
    if (result == LMP_ERROR_MEMORY)
        return note_without(
            m, "its preintegrated table takes more than 128 MB, or making it ran out of memory");
    return result == LMP_OK || base_fail(error, m->name, "%s", lmp_result_text(result));
}
