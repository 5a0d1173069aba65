/* SPDX-License-Identifier: MIT */
/* brdf_bytes.c - the file format .lmps (docs/formats.md): header, remaps, views, slices, texels.
 */
#include "src/base/bytes.h"
#include "src/base/parse_error.h"

#include "src/preintegrated/brdf.h"

#define HEADER      68u
#define SLICE_BYTES 24u
static const lmpi_bytes_format format = { .name = "preintegrated BRDF (.lmps)",
                                          .magic = { 'L', 'M', 'P', 'S', 0x0d, 0x0a, 0x1a, 0x0a },
                                          .version = 1,
                                          .header = HEADER };

static size_t body_size(const lmp_preintegrated_brdf_info *info) {
    return 4 * ((size_t)info->view_steps + 1 + info->cap_steps + 1) +
           12 * (size_t)info->view_count +
           SLICE_BYTES * (size_t)info->view_count * info->cap_count + 6 * info->texel_count;
}

size_t lmp_preintegrated_brdf_size(const lmp_preintegrated_brdf *brdf) {
    return HEADER + body_size(&brdf->info) + LMPI_BYTES_CHECKSUM;
}

static unsigned char *store_floats(unsigned char *p, const float *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        p = lmpi_bytes_store_f32(p, values[i]);
    return p;
}

static unsigned char *store_header(void *bytes, const lmp_preintegrated_brdf_info *info) {
    const float numbers[] = { info->window_size, info->error, info->width,     info->radius,
                              info->reach,       info->slope, info->lobe_angle };
    unsigned char *p = lmpi_bytes_begin(bytes, &format);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->bands);
    p = lmpi_bytes_store_u16(p, (uint16_t)info->window);
    p = lmpi_bytes_store_u16(p, info->mirrored);
    p = store_floats(p, numbers, sizeof numbers / sizeof *numbers);
    p = lmpi_bytes_store_u32(p, info->view_count);
    p = lmpi_bytes_store_u32(p, info->cap_count);
    p = lmpi_bytes_store_u32(p, info->view_steps);
    p = lmpi_bytes_store_u32(p, info->cap_steps);
    return lmpi_bytes_store_u32(p, (uint32_t)info->texel_count);
}

lmp_result lmp_preintegrated_brdf_write(const lmp_preintegrated_brdf *brdf, size_t size,
                                        void *bytes) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    if (size < lmp_preintegrated_brdf_size(brdf))
        return LMP_ERROR_ARGUMENT;
    unsigned char *p = store_header(bytes, info);
    p = store_floats(p, info->view_remap, (size_t)info->view_steps + 1);
    p = store_floats(p, info->cap_remap, (size_t)info->cap_steps + 1);
    p = store_floats(p, &info->ambient->r, 3 * (size_t)info->view_count);
    for (size_t i = 0; i < (size_t)info->view_count * info->cap_count; i++) {
        const lmp_preintegrated_brdf_slice *slice = &info->slices[i];
        p = lmpi_bytes_store_u32(p, slice->rows);
        p = lmpi_bytes_store_u32(p, slice->columns);
        p = lmpi_bytes_store_f32(p, slice->row_density);
        p = lmpi_bytes_store_f32(p, slice->row_origin);
        p = lmpi_bytes_store_f32(p, slice->column_density);
        p = lmpi_bytes_store_f32(p, slice->unit);
    }
    for (size_t i = 0; i < 3 * info->texel_count; i++)
        p = lmpi_bytes_store_u16(p, (uint16_t)info->texels[i]);
    lmpi_bytes_end(bytes, p);
    return LMP_OK;
}

/* --- reading ---------------------------------------------------------------------------------- */

static bool positive(float value) {
    return value > 0 && value <= 1e9f;
}

/* Reads the numbers that describe a BRDF, and checks that their sizes agree with the file's. */
static bool read_header(const unsigned char *bytes, size_t size,
                        lmp_preintegrated_brdf_info *info) {
    const unsigned char *p = bytes + LMPI_BYTES_BEGIN;
    const uint32_t bands = lmpi_bytes_load_u32(&p);
    const uint16_t window = lmpi_bytes_load_u16(&p), mirrored = lmpi_bytes_load_u16(&p);
    if (bands < 1 || bands > LMP_BANDS_MAX || window >= LMP_WINDOW_COUNT || mirrored > 1)
        return false;
    info->bands = (int)bands;
    info->window = (lmp_window)window;
    info->mirrored = mirrored != 0;
    info->window_size = lmpi_bytes_load_f32(&p); /* only kept, and not checked: it is the table's */
    if (!(info->window_size > 0 && isfinite(info->window_size)))
        return false;
    float *const numbers[] = { &info->error, &info->width, &info->radius,
                               &info->reach, &info->slope, &info->lobe_angle };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        *numbers[i] = lmpi_bytes_load_f32(&p);
        if (!positive(*numbers[i]))
            return false;
    }
    info->view_count = lmpi_bytes_load_u32(&p);
    info->cap_count = lmpi_bytes_load_u32(&p);
    info->view_steps = lmpi_bytes_load_u32(&p);
    info->cap_steps = lmpi_bytes_load_u32(&p);
    info->texel_count = lmpi_bytes_load_u32(&p);
    return info->view_steps >= 1 && info->view_steps <= BRDF_STEPS_MAX && info->cap_steps >= 1 &&
           info->cap_steps <= BRDF_STEPS_MAX && info->view_count >= 2 &&
           info->view_count <= info->view_steps + 1 && info->cap_count >= 2 &&
           info->cap_count <= info->cap_steps + 1 &&
           size == HEADER + body_size(info) + LMPI_BYTES_CHECKSUM;
}

/* Reads a remap, which rises from 0 to the last slice. */
static bool read_remap(const unsigned char **p, uint32_t steps, uint32_t slices, float *remap) {
    for (uint32_t i = 0; i <= steps; i++) {
        remap[i] = lmpi_bytes_load_f32(p);
        if (i > 0 ? !(remap[i] > remap[i - 1]) : !(remap[0] >= 0))
            return false;
    }
    return remap[steps] <= (float)(slices - 1);
}

/* Reads the slices, which follow one another and use all texels. */
static bool read_slices(const unsigned char **p, lmp_preintegrated_brdf *brdf) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    size_t first = 0;
    for (size_t i = 0; i < (size_t)info->view_count * info->cap_count; i++) {
        lmp_preintegrated_brdf_slice slice = { .first = (uint32_t)first };
        slice.rows = lmpi_bytes_load_u32(p);
        slice.columns = lmpi_bytes_load_u32(p);
        slice.row_density = lmpi_bytes_load_f32(p);
        slice.row_origin = lmpi_bytes_load_f32(p);
        slice.column_density = lmpi_bytes_load_f32(p);
        slice.unit = lmpi_bytes_load_f32(p);
        if (slice.rows < 4 || slice.columns < 4 || slice.rows > 1u << 15 ||
            slice.columns > 1u << 15 || !positive(slice.row_density) ||
            !positive(slice.column_density) || !positive(slice.unit) ||
            !(fabsf(slice.row_origin) <= 1e9f))
            return false;
        first += (size_t)slice.rows * slice.columns;
        if (first > info->texel_count)
            return false;
        brdf->slices[i] = slice;
    }
    return first == info->texel_count;
}

/* Reads all after the header, and moves *from to where it ceased to be valid. */
static bool read_body(const unsigned char **from, lmp_preintegrated_brdf *brdf) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    if (!read_remap(from, info->view_steps, info->view_count, brdf->view_remap) ||
        !read_remap(from, info->cap_steps, info->cap_count, brdf->cap_remap))
        return false;
    for (size_t i = 0; i < 3 * (size_t)info->view_count; i++) {
        (&brdf->ambient->r)[i] = lmpi_bytes_load_f32(from);
        if (!(fabsf((&brdf->ambient->r)[i]) <= 1e30f))
            return false;
    }
    if (!read_slices(from, brdf))
        return false;
    lmpi_bytes_load_i16s(*from, 3 * info->texel_count, brdf->texels);
    return true;
}

lmp_result lmp_preintegrated_brdf_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_parse_error *error, lmp_preintegrated_brdf **brdf) {
    *brdf = NULL;
    const unsigned char *bytes = data;
    lmp_result result = lmpi_bytes_check_frame(data, size, &format, error);
    if (result != LMP_OK)
        return result;
    lmp_preintegrated_brdf_info info = { 0 };
    if (!read_header(data, size, &info))
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, LMPI_BYTES_BEGIN,
                               "a number of the header is out of range, or its counts do not make "
                               "%zu bytes",
                               size);
    result = lmpi_preintegrated_brdf_allocate(host, &info, brdf);
    if (result != LMP_OK)
        return lmpi_parse_fail(error, result, 0, "out of memory for the BRDF");
    const unsigned char *p = bytes + HEADER;
    if (read_body(&p, *brdf))
        return LMP_OK;
    lmp_preintegrated_brdf_destroy(*brdf);
    *brdf = NULL;
    return lmpi_parse_fail(error, LMP_ERROR_FORMAT, (size_t)(p - bytes),
                           "a remap, an ambient value or a slice is not valid");
}
