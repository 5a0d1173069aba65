/* SPDX-License-Identifier: MIT */
/* The file format of tables, .lmpt (docs/formats.md). */
#include "src/brdf/table.h"

#include <math.h>

#define HEADER 48u
static const lmpi_bytes_format format = { .name = "table (.lmpt)",
                                          .magic = { 'L', 'M', 'P', 'T', 0x0d, 0x0a, 0x1a, 0x0a },
                                          .version = 1,
                                          .header = HEADER };

static size_t float_count(const lmp_brdf_table_info *info) {
    return 3 * info->count * (size_t)info->views * (size_t)info->azimuths;
}

size_t lmp_brdf_table_size(const lmp_brdf_table *table) {
    return HEADER + 4 * float_count(&table->info) + LMPI_BYTES_CHECKSUM;
}

lmp_result lmp_brdf_table_write(const lmp_brdf_table *table, size_t size, void *bytes) {
    const lmp_brdf_table_info *info = &table->info;
    if (size < lmp_brdf_table_size(table))
        return LMP_ERROR_ARGUMENT;
    unsigned char *p = lmpi_bytes_begin(bytes, &format);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->bands);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->views);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->azimuths);
    p = lmpi_bytes_store_u32(p, info->mirrored);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->window);
    p = lmpi_bytes_store_f32(p, info->window_size);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->rings);
    p = lmpi_bytes_store_f32(p, info->change);
    p = lmpi_bytes_store_u32(p, 0);
    for (size_t i = 0; i < float_count(info); i++)
        p = lmpi_bytes_store_f32(p, table->coefficients[i]);
    lmpi_bytes_end(bytes, p);
    return LMP_OK;
}

/* Reads one integer of the header and checks that it is in its range. */
static lmp_result take(const unsigned char *bytes, size_t offset, const char *what,
                       uint32_t minimum, uint32_t maximum, int *value, lmp_parse_error *error) {
    const uint32_t n = lmpi_bytes_at_u32(bytes + offset);
    if (n < minimum || n > maximum)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, offset, "%s is %zu, not in %zu to %zu",
                               what, (size_t)n, (size_t)minimum, (size_t)maximum);
    *value = (int)n;
    return LMP_OK;
}

static lmp_result read_header(const unsigned char *bytes, size_t size, lmp_brdf_table_info *info,
                              lmp_parse_error *error) {
    int mirrored = 0, window = 0;
    lmp_result result = lmpi_bytes_check_begin(bytes, size, &format, error);
    if (result != LMP_OK)
        return result;
    result = take(bytes, 12, "bands", 1, LMP_BANDS_MAX, &info->bands, error);
    if (result == LMP_OK)
        result = take(bytes, 16, "views", 2, BRDF_VIEWS_MAX, &info->views, error);
    if (result == LMP_OK)
        result = take(bytes, 20, "azimuths", 1, BRDF_AZIMUTHS_MAX, &info->azimuths, error);
    if (result == LMP_OK && info->azimuths > 1 && (info->azimuths < 4 || info->azimuths % 2))
        result = lmpi_parse_fail(error, LMP_ERROR_FORMAT, 20, "azimuths is %d, not 1 or even",
                                 info->azimuths);
    if (result == LMP_OK)
        result = take(bytes, 24, "mirrored", 0, info->azimuths == 1, &mirrored, error);
    if (result == LMP_OK)
        result = take(bytes, 28, "window", LMP_WINDOW_NONE, LMP_WINDOW_COUNT - 1, &window, error);
    if (result == LMP_OK)
        result = take(bytes, 36, "rings", 1, 1 << 20, &info->rings, error);
    info->mirrored = mirrored != 0;
    info->window = (lmp_window)window;
    info->window_size = lmpi_bytes_at_f32(bytes + 32);
    info->change = lmpi_bytes_at_f32(bytes + 40);
    if (result == LMP_OK && !(info->window_size > 0 && isfinite(info->window_size)))
        result = lmpi_parse_fail(error, LMP_ERROR_FORMAT, 32, "window size is not positive");
    if (result == LMP_OK && !(info->change >= 0 && isfinite(info->change)))
        result = lmpi_parse_fail(error, LMP_ERROR_FORMAT, 40, "change is not a finite number");
    return result;
}

lmp_result lmp_brdf_table_read(const lmp_host *host, const void *data, size_t size,
                               lmp_parse_error *error, lmp_brdf_table **table) {
    *table = NULL;
    const unsigned char *bytes = data;
    lmp_brdf_table_info info = { 0 };
    lmp_result result = read_header(bytes, size, &info, error);
    if (result != LMP_OK)
        return result;
    info.count = info.mirrored ? LMP_SH_HALF_COUNT(info.bands) : LMP_SH_COUNT(info.bands);
    const uint64_t wanted =
        HEADER + LMPI_BYTES_CHECKSUM +
        UINT64_C(12) * info.count * (uint64_t)info.views * (uint64_t)info.azimuths;
    if (wanted != size)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, 12,
                               "%d bands, %d views, %d azimuths need %zu bytes, the file has %zu",
                               info.bands, info.views, info.azimuths, (size_t)wanted, size);
    result = lmpi_bytes_check_end(bytes, size, error);
    if (result != LMP_OK)
        return result;
    result = lmpi_brdf_table_new(host, &info, table);
    if (result != LMP_OK)
        return lmpi_parse_fail(error, result, 0, "out of memory for the table");
    for (size_t i = 0; i < float_count(&info); i++) {
        (*table)->coefficients[i] = lmpi_bytes_at_f32(bytes + HEADER + 4 * i);
        if (!isfinite((*table)->coefficients[i])) {
            lmp_brdf_table_destroy(*table);
            *table = NULL;
            return lmpi_parse_fail(error, LMP_ERROR_FORMAT, HEADER + 4 * i,
                                   "coefficient %zu is not a finite number", i);
        }
    }
    return LMP_OK;
}
