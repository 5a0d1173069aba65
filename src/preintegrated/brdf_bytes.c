/* SPDX-License-Identifier: MIT */
/* brdf_bytes.c - the file format .lmps (docs/formats.md): header, remaps, views, slices, texels.
 */
#include "src/base/bytes.h"

#include "src/preintegrated/brdf.h"

#define HEADER      68u
#define SLICE_BYTES 24u
static const lmp_bytes_format format = { .magic = { 'L', 'M', 'P', 'S', 0x0d, 0x0a, 0x1a, 0x0a },
                                         .version = 1,
                                         .header = HEADER };

static size_t body_size(const lmp_preintegrated_brdf_info *info) {
    return 4 * ((size_t)info->view_steps + 1 + info->cap_steps + 1) +
           12 * (size_t)info->view_count +
           SLICE_BYTES * (size_t)info->view_count * info->cap_count + 6 * info->texel_count;
}

size_t lmp_preintegrated_brdf_size(const lmp_preintegrated_brdf *brdf) {
    return HEADER + body_size(&brdf->info) + LMP_BYTES_CHECKSUM;
}

static unsigned char *store_floats(unsigned char *p, const float *values, size_t count) {
    for (size_t i = 0; i < count; i++)
        p = lmp_bytes_store_f32(p, values[i]);
    return p;
}

static unsigned char *store_header(void *bytes, const lmp_preintegrated_brdf_info *info) {
    const float numbers[] = { info->window_size, info->error, info->width,     info->radius,
                              info->reach,       info->slope, info->lobe_angle };
    unsigned char *p = lmp_bytes_begin(bytes, &format);
    p = lmp_bytes_store_u32(p, (uint32_t)info->bands);
    p = lmp_bytes_store_u16(p, (uint16_t)info->window);
    p = lmp_bytes_store_u16(p, info->mirrored);
    p = store_floats(p, numbers, sizeof numbers / sizeof *numbers);
    p = lmp_bytes_store_u32(p, info->view_count);
    p = lmp_bytes_store_u32(p, info->cap_count);
    p = lmp_bytes_store_u32(p, info->view_steps);
    p = lmp_bytes_store_u32(p, info->cap_steps);
    return lmp_bytes_store_u32(p, (uint32_t)info->texel_count);
}

void lmp_preintegrated_brdf_write(const lmp_preintegrated_brdf *brdf, void *bytes) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    unsigned char *p = store_header(bytes, info);
    p = store_floats(p, info->view_remap, (size_t)info->view_steps + 1);
    p = store_floats(p, info->cap_remap, (size_t)info->cap_steps + 1);
    p = store_floats(p, &info->ambient->r, 3 * (size_t)info->view_count);
    for (size_t i = 0; i < (size_t)info->view_count * info->cap_count; i++) {
        const lmp_preintegrated_brdf_slice *slice = &info->slices[i];
        p = lmp_bytes_store_u32(p, slice->rows);
        p = lmp_bytes_store_u32(p, slice->columns);
        p = lmp_bytes_store_f32(p, slice->row_density);
        p = lmp_bytes_store_f32(p, slice->row_origin);
        p = lmp_bytes_store_f32(p, slice->column_density);
        p = lmp_bytes_store_f32(p, slice->unit);
    }
    for (size_t i = 0; i < 3 * info->texel_count; i++)
        p = lmp_bytes_store_u16(p, (uint16_t)info->texels[i]);
    lmp_bytes_end(bytes, p);
}

/* --- reading ---------------------------------------------------------------------------------- */

static bool positive(float value) {
    return value > 0 && value <= 1e9f;
}

/* Numbers that describe a brdf, of a size that agrees with the file's. */
static bool read_header(const unsigned char *bytes, size_t size,
                        lmp_preintegrated_brdf_info *info) {
    const unsigned char *p = bytes + LMP_BYTES_BEGIN;
    const uint32_t bands = lmp_bytes_load_u32(&p);
    const uint16_t window = lmp_bytes_load_u16(&p), mirrored = lmp_bytes_load_u16(&p);
    if (bands < 1 || bands > LMP_BANDS_MAX || window >= LMP_WINDOWS || mirrored > 1)
        return false;
    info->bands = (int)bands;
    info->window = (lmp_window)window;
    info->mirrored = mirrored != 0;
    info->window_size = lmp_bytes_load_f32(&p); /* only kept: of any table */
    if (!(info->window_size > 0 && isfinite(info->window_size)))
        return false;
    float *const numbers[] = { &info->error, &info->width, &info->radius,
                               &info->reach, &info->slope, &info->lobe_angle };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        *numbers[i] = lmp_bytes_load_f32(&p);
        if (!positive(*numbers[i]))
            return false;
    }
    info->view_count = lmp_bytes_load_u32(&p);
    info->cap_count = lmp_bytes_load_u32(&p);
    info->view_steps = lmp_bytes_load_u32(&p);
    info->cap_steps = lmp_bytes_load_u32(&p);
    info->texel_count = lmp_bytes_load_u32(&p);
    return info->view_steps >= 1 && info->view_steps <= BRDF_STEPS_MAX && info->cap_steps >= 1 &&
           info->cap_steps <= BRDF_STEPS_MAX && info->view_count >= 2 &&
           info->view_count <= info->view_steps + 1 && info->cap_count >= 2 &&
           info->cap_count <= info->cap_steps + 1 &&
           size == HEADER + body_size(info) + LMP_BYTES_CHECKSUM;
}

/* Rising from 0 to the last slice. */
static bool read_remap(const unsigned char **p, uint32_t steps, uint32_t slices, float *remap) {
    for (uint32_t i = 0; i <= steps; i++) {
        remap[i] = lmp_bytes_load_f32(p);
        if (i > 0 ? !(remap[i] > remap[i - 1]) : !(remap[0] >= 0))
            return false;
    }
    return remap[steps] <= (float)(slices - 1);
}

/* Slices one after another, all texels used. */
static bool read_slices(const unsigned char **p, lmp_preintegrated_brdf *brdf) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    size_t first = 0;
    for (size_t i = 0; i < (size_t)info->view_count * info->cap_count; i++) {
        lmp_preintegrated_brdf_slice slice = { .first = (uint32_t)first };
        slice.rows = lmp_bytes_load_u32(p);
        slice.columns = lmp_bytes_load_u32(p);
        slice.row_density = lmp_bytes_load_f32(p);
        slice.row_origin = lmp_bytes_load_f32(p);
        slice.column_density = lmp_bytes_load_f32(p);
        slice.unit = lmp_bytes_load_f32(p);
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

static bool read_body(const unsigned char *p, lmp_preintegrated_brdf *brdf) {
    const lmp_preintegrated_brdf_info *info = &brdf->info;
    if (!read_remap(&p, info->view_steps, info->view_count, brdf->view_remap) ||
        !read_remap(&p, info->cap_steps, info->cap_count, brdf->cap_remap))
        return false;
    for (size_t i = 0; i < 3 * (size_t)info->view_count; i++) {
        (&brdf->ambient->r)[i] = lmp_bytes_load_f32(&p);
        if (!(fabsf((&brdf->ambient->r)[i]) <= 1e30f))
            return false;
    }
    if (!read_slices(&p, brdf))
        return false;
    lmp_bytes_load_i16s(p, 3 * info->texel_count, brdf->texels);
    return true;
}

lmp_result lmp_preintegrated_brdf_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_preintegrated_brdf **brdf) {
    *brdf = NULL;
    const lmp_result framed = lmp_bytes_check_frame(data, size, &format);
    if (framed != LMP_OK)
        return framed;
    lmp_preintegrated_brdf_info info = { 0 };
    if (!read_header(data, size, &info))
        return LMP_ERROR_FORMAT;
    const lmp_result result = lmp_preintegrated_brdf_allocate(host, &info, brdf);
    if (result != LMP_OK || read_body((const unsigned char *)data + HEADER, *brdf))
        return result;
    lmp_preintegrated_brdf_destroy(*brdf);
    *brdf = NULL;
    return LMP_ERROR_FORMAT;
}
