/* SPDX-License-Identifier: MIT */
#include "app/device/device.h"
#include "app/file/file.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 4096, RESPONSE_BYTES_MAX = 1 << 28 };

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
    (void)user;
    if (omp_get_thread_num() == 0)
        cli_progress("integrating lobes", done);
}

/* What decides the bytes: how they are made, and what is asked for. */
static bool cache_path(const lmp_response_desc *desc, char path[PATH_SIZE]) {
    char text[33], name[64];
    const struct {
        uint32_t library;
        int32_t bands, window;
    } key = { lmp_version(), desc->bands, (int32_t)desc->window };
    file_hash hash = { 0 };
    file_hash_add(&hash, "response 1", 10);
    file_hash_add(&hash, &key, sizeof key);
    file_hash_text(&hash, text);
    snprintf(name, sizeof name, "%s.lmpr", text);
    return file_cache_path(name, path, PATH_SIZE);
}

/* A cache that cannot be read is no cache. */
static bool read_cached(const char *path, const lmp_response_desc *desc, lmp_response **response) {
    cli_error ignored;
    void *data;
    size_t size;
    if (!file_read(path, RESPONSE_BYTES_MAX, &data, &size, &ignored))
        return false;
    const lmp_result result = lmp_response_read(NULL, data, size, response);
    free(data);
    if (result != LMP_OK)
        return false;
    const lmp_response_info info = lmp_response_describe(*response);
    if (info.bands == desc->bands && info.window == desc->window)
        return true;
    lmp_response_destroy(*response);
    return false;
}

static void write_cached(const char *path, const lmp_response *response) {
    const size_t size = lmp_response_size(response);
    void *bytes = malloc(size);
    if (bytes) {
        lmp_response_write(response, bytes);
        file_cache_store(path, bytes, size);
    }
    free(bytes);
}

bool device_response(int bands, lmp_window window, lmp_response **response, cli_error *error) {
    const lmp_response_desc desc = {
        .bands = bands, .window = window, .parallel = parallel, .progress = progress
    };
    char path[PATH_SIZE];
    const bool cached = cache_path(&desc, path);
    if (cached && read_cached(path, &desc, response))
        return true;
    const lmp_result result = lmp_response_create(NULL, &desc, response);
    cli_progress_end();
    if (result != LMP_OK)
        return cli_fail(error, NULL, "the lobes of %d bands: %s", bands, lmp_result_text(result));
    if (cached)
        write_cached(path, *response);
    return true;
}
