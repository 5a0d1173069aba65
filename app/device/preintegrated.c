/* SPDX-License-Identifier: MIT */
#define _DEFAULT_SOURCE /* madvise */
#include "app/device/device.h"
#include "app/file/file.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Rises when the same table, bands and window give other numbers than they did. */
#define CACHE_EPOCH 3

const char *const device_window_names[] = {
    [LMP_WINDOW_NONE] = "none",
    [LMP_WINDOW_HANNING] = "hanning",
    [LMP_WINDOW_LANCZOS] = "lanczos",
    NULL,
};

static void parallel(void *user, size_t count, void (*task)(size_t index, void *data), void *data) {
    (void)user;
    const long tasks = (long)count;
#pragma omp parallel for schedule(dynamic)
    for (long i = 0; i < tasks; i++)
        task((size_t)i, data);
}

static void progress(void *user, double done) {
    if (omp_get_thread_num() == 0)
        cli_progress((const char *)user, done);
}

/* --- the cache ----------------------------------------------------------------------------------
 */

typedef char entry_name[64];

/* What decides the bytes of a response: of which `what`, and how it is made. */
static const char *name_entry(file_hash hash, const char *what, int bands, lmp_window window,
                              float window_size, entry_name name) {
    char text[33];
    const struct {
        uint32_t library;
        int32_t epoch, bands, window;
        float window_size;
    } key = { lmp_version(), CACHE_EPOCH, bands, (int32_t)window, window_size };
    file_hash_add(&hash, what, strlen(what));
    file_hash_add(&hash, &key, sizeof key);
    file_hash_text(&hash, text);
    snprintf(name, sizeof(entry_name), "%s.%s", text, what);
    return name;
}

/* --- lobes --------------------------------------------------------------------------------------
 */

static lmp_preintegrated_lobe *read_lobes(const char *name,
                                          const lmp_preintegrated_lobe_desc *desc) {
    size_t size;
    const void *data = file_cache_map(name, &size);
    lmp_preintegrated_lobe *response = NULL;
    if (data)
        lmp_preintegrated_lobe_read(NULL, data, size, &response);
    file_cache_unmap(data, size);
    if (!response)
        return NULL;
    const lmp_preintegrated_lobe_info info = lmp_preintegrated_lobe_describe(response);
    if (info.bands == desc->bands && info.window == desc->window)
        return response;
    lmp_preintegrated_lobe_destroy(response);
    return NULL;
}

static void write_lobes(const void *response, void *bytes) {
    lmp_preintegrated_lobe_write(response, bytes);
}

bool device_preintegrated_lobe(int bands, lmp_window window, lmp_preintegrated_lobe **response,
                               cli_error *error) {
    static char what[] = "integrating lobes";
    const lmp_preintegrated_lobe_desc desc = {
        .bands = bands,
        .window = window,
        .error = DEVICE_LOBES_ERROR,
        .parallel = parallel,
        .progress = progress,
        .user = what,
    };
    entry_name name;
    name_entry((file_hash) { 0 }, "lmpr", bands, window, 0, name);
    if ((*response = read_lobes(name, &desc)))
        return true;
    const lmp_result result = lmp_preintegrated_lobe_create(NULL, &desc, response);
    cli_progress_end();
    if (result != LMP_OK)
        return cli_fail(error, NULL, "the lobes of %d bands: %s", bands, lmp_result_text(result));
    file_cache_store_object(name, lmp_preintegrated_lobe_size(*response), write_lobes, *response);
    return true;
}

/* --- measured materials --------------------------------------------------------------------------
 */

/* Memory in large pages where the system has them: a response's fresh pages cost more than its
 * bytes. */
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

static lmp_preintegrated_brdf *read_measured(const char *name) {
    static const lmp_allocator large = { allocate_large, release_large, NULL };

    size_t size;
    const void *data = file_cache_map(name, &size);
    lmp_preintegrated_brdf *response = NULL;
    if (data)
        lmp_preintegrated_brdf_read(&large, data, size, &response);
    file_cache_unmap(data, size);
    return response;
}

static void write_measured(const void *response, void *bytes) {
    lmp_preintegrated_brdf_write(response, bytes);
}

/* Says why a material is summed by its bands. */
static void note_without(const material *from, const char *why) {
    fprintf(stderr, "lampion: %s: %s: shaded by its bands (as by --method coefficients)\n",
            from->name, why);
}

bool device_preintegrated_brdf(const material *from, const lmp_brdf_table *table,
                               lmp_preintegrated_brdf **response, cli_error *error) {
    static char what[] = "integrating the BRDF";
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const lmp_preintegrated_brdf_desc desc = { .parallel = parallel,
                                               .progress = progress,
                                               .user = what };
    entry_name name;
    *response = NULL;
    if (info.azimuths > 1) {
        note_without(from, "an anisotropic material's response would take gigabytes");
        return true;
    }
    name_entry(from->hash, "lmps", info.bands, info.window, info.window_size, name);
    if ((*response = read_measured(name)))
        return true;
    const lmp_result result = lmp_preintegrated_brdf_create(NULL, table, &desc, response);
    cli_progress_end();
    if (result == LMP_ERROR_MEMORY) {
        note_without(from, "its response takes more than 128 MB, or there is no memory to make it");
        return true;
    }
    if (result != LMP_OK)
        return cli_fail(error, from->name, "%s", lmp_result_text(result));
    file_cache_store_object(name, lmp_preintegrated_brdf_size(*response), write_measured,
                            *response);
    return true;
}
