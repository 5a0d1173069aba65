/* SPDX-License-Identifier: MIT */
/* Tables of BRDFs for shaders/program/table.glsl. */
#include "app/render/gl/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows and columns of views, between which shaders interpolate. */
enum { ROWS = 1024, ANISOTROPIC_ROWS = 192, COLUMNS_OF_AZIMUTH = 4 };

/* The most vectors in the buffer of all tables. */
enum { VALUES_MAX = 1 << 23 };

static gpu_table_shape shape_of(const lmp_brdf_table_info *info) {
    if (info->azimuths == 1)
        return (gpu_table_shape) { ROWS, 1 };
    return (gpu_table_shape) { ANISOTROPIC_ROWS, (size_t)(COLUMNS_OF_AZIMUTH * info->azimuths) };
}

/* Converts so many bands of one view to vec4s in the shader's order. */
static void fill_view(const lmp_brdf_table_info *info, int bands, bool full, const float *rgb,
                      vec4 *to) {
    for (int l = 0; l < bands && l < info->bands; l++)
        for (int m = full ? -l : 0; m <= l; m++, to++)
            for (size_t c = 0; c < 3; c++) {
                const size_t i = info->mirrored ? LMP_SH_HALF_INDEX(l, m) : LMP_SH_INDEX(l, m);
                (*to)[c] = info->mirrored && m < 0 ? 0 : rgb[c * info->count + i];
            }
}

bool gpu_table_fill(const lmp_brdf_table *table, gpu_table_shape shape, int bands, bool full,
                    size_t stride, vec4 *values) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    float *rgb = malloc(3 * info.count * sizeof *rgb);
    if (!rgb)
        return false;
    for (size_t column = 0; column < shape.columns; column++)
        for (size_t row = 0; row < shape.rows; row++, values += stride) {
            const double theta = 1.5707963267949 * (double)row / (double)(shape.rows - 1);
            const double phi = 6.2831853071796 * (double)column / (double)shape.columns;
            lmp_brdf_table_interpolate(table, (float)cos(theta), (float)phi, rgb);
            fill_view(&info, bands, full, rgb, values);
        }
    free(rgb);
    return true;
}

/* Whether frames of a method sum table t by its bands, for lights or for an environment. */
static bool by_bands(const render_materials *materials, const environment *around,
                     method_kind method, int t) {
    return !(method_table[method].reads & METHOD_READS_PREINTEGRATED) || !materials->brdfs[t] ||
           environment_shines(around);
}

void gpu_tables_free(gpu_tables *own) {
    gpu_texels_free(&own->values);
}

int gpu_tables_by_bands(const render_materials *materials, const environment *around,
                        method_kind method) {
    int tables = 0;
    for (int t = 0; t < materials->table_count; t++)
        if (by_bands(materials, around, method, t)) {
            const int one = lmp_brdf_table_describe(materials->tables[t]).mirrored ? 1 : 2;
            tables = one > tables ? one : tables;
        }
    return tables;
}

/* Counts the buffer's vectors: one per table, then the values of tables that are summed by
 * bands. */
static size_t count_values(const render_materials *materials, const environment *around,
                           method_kind method, size_t stride) {
    size_t total = (size_t)materials->table_count;
    for (int t = 0; t < materials->table_count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(materials->tables[t]);
        const gpu_table_shape shape = shape_of(&info);
        total += by_bands(materials, around, method, t) ? shape.rows * shape.columns * stride : 0;
    }
    return total;
}

static bool fill_tables(const render_materials *materials, const environment *around,
                        method_kind method, int bands, bool full, size_t stride, vec4 *values) {
    size_t first = (size_t)materials->table_count;
    for (int t = 0; t < materials->table_count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(materials->tables[t]);
        const gpu_table_shape shape = shape_of(&info);
        if (!by_bands(materials, around, method, t))
            continue;
        values[t][0] = (float)first;
        values[t][1] = (float)shape.rows;
        values[t][2] = (float)shape.columns;
        if (!gpu_table_fill(materials->tables[t], shape, bands, full, stride, values + first))
            return false;
        first += shape.rows * shape.columns * stride;
    }
    return true;
}

static bool too_large(base_error *error) {
    return base_fail(error, NULL, "the tables of the materials are too large (fewer --bands)");
}

bool gpu_tables_would_fit(const environment *around, method_kind method,
                          const lmp_brdf_table_info *tables, int count, base_error *error) {
    const bool preintegrates =
        method_table[method].reads & METHOD_READS_PREINTEGRATED && !environment_shines(around);
    size_t views = 0;
    bool mirrored = true;
    for (int t = 0; t < count; t++) {
        if (preintegrates && tables[t].azimuths == 1)
            continue;
        const gpu_table_shape shape = shape_of(&tables[t]);
        views += shape.rows * shape.columns;
        mirrored = mirrored && tables[t].mirrored;
    }
    const int bands = count ? tables[0].bands : 1;
    const size_t stride = mirrored ? LMP_SH_HALF_COUNT(bands) : LMP_SH_COUNT(bands);
    return (size_t)count + views * stride < VALUES_MAX || too_large(error);
}

bool gpu_tables_bind(gpu_tables *own, const render_materials *materials, const environment *around,
                     method_kind method, int bands, base_error *error) {
    const int tables = gpu_tables_by_bands(materials, around, method);
    if (!own->values.buffer || own->method != method || own->bands != bands) {
        const size_t stride = tables == 2 ? LMP_SH_COUNT(bands) : LMP_SH_HALF_COUNT(bands);
        const size_t total = count_values(materials, around, method, stride);
        vec4 *values = total < VALUES_MAX ? calloc(total + 1, sizeof *values) : NULL;
        if (!values ||
            !fill_tables(materials, around, method, bands, tables == 2, stride, values)) {
            free(values);
            return too_large(error);
        }
        gpu_texels_create(&own->values, (total + 1) * sizeof *values, values);
        own->method = method;
        own->bands = bands;
        free(values);
    }
    gpu_texels_bind(&own->values, SHARED_TABLES);
    return true;
}
