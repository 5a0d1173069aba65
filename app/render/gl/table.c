/* SPDX-License-Identifier: MIT */
/* Tables of BRDFs for shaders/table.glsl. */
#include "app/render/gl/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows and columns that linear interpolation reads. */
enum { ROWS = 1024, ANISOTROPIC_ROWS = 192, COLUMNS_OF_AZIMUTH = 4 };

/* Vectors that the buffer of all may hold. */
enum { VALUES_MAX = 1 << 23 };

static gpu_table_shape shape_of(const lmp_brdf_table_info *info) {
    if (info->azimuths == 1)
        return (gpu_table_shape) { ROWS, 1 };
    return (gpu_table_shape) { ANISOTROPIC_ROWS, (size_t)(COLUMNS_OF_AZIMUTH * info->azimuths) };
}

/* So many bands of one view as vec4s in the order of the shader. */
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
            lmp_brdf_table_view(table, (float)cos(theta), (float)phi, rgb);
            fill_view(&info, bands, full, rgb, values);
        }
    free(rgb);
    return true;
}

/* Whether frames of a method sum table t by its bands: under lights, or under an environment. */
static bool by_bands(const gpu_renderer *r, method_kind method, int t) {
    return !(method_table[method].reads & METHOD_READS_PREINTEGRATED) || !r->materials.brdfs[t] ||
           environment_shines(r->environment);
}

void gpu_forget_tables(gpu_renderer *r) {
    glDeleteBuffers(1, &r->tables_buffer);
    r->tables_buffer = 0;
}

int gpu_tables_by_bands(const gpu_renderer *r, method_kind method) {
    int tables = 0;
    for (int t = 0; t < r->materials.table_count; t++)
        if (by_bands(r, method, t)) {
            const int one = lmp_brdf_table_describe(r->materials.tables[t]).mirrored ? 1 : 2;
            tables = one > tables ? one : tables;
        }
    return tables;
}

/* Vectors of the buffer: one a table, then the values of those summed by bands. */
static size_t count_values(const gpu_renderer *r, method_kind method, size_t stride) {
    size_t total = (size_t)r->materials.table_count;
    for (int t = 0; t < r->materials.table_count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(r->materials.tables[t]);
        const gpu_table_shape shape = shape_of(&info);
        total += by_bands(r, method, t) ? shape.rows * shape.columns * stride : 0;
    }
    return total;
}

static bool fill_tables(const gpu_renderer *r, method_kind method, int bands, bool full,
                        size_t stride, vec4 *values) {
    size_t first = (size_t)r->materials.table_count;
    for (int t = 0; t < r->materials.table_count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(r->materials.tables[t]);
        const gpu_table_shape shape = shape_of(&info);
        if (!by_bands(r, method, t))
            continue;
        values[t][0] = (float)first;
        values[t][1] = (float)shape.rows;
        values[t][2] = (float)shape.columns;
        if (!gpu_table_fill(r->materials.tables[t], shape, bands, full, stride, values + first))
            return false;
        first += shape.rows * shape.columns * stride;
    }
    return true;
}

static bool too_large(cli_error *error) {
    return cli_fail(error, NULL, "the tables of the materials are too large (fewer --bands)");
}

bool gpu_tables_fit(const gpu_renderer *r, method_kind method, const lmp_brdf_table_info *tables,
                    int count, cli_error *error) {
    const bool preintegrates = method_table[method].reads & METHOD_READS_PREINTEGRATED &&
                               !environment_shines(r->environment);
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

bool gpu_bind_tables(gpu_renderer *r, method_kind method, int bands, cli_error *error) {
    const int tables = gpu_tables_by_bands(r, method);
    if (!r->tables_buffer || r->tables_method != method || r->tables_bands != bands) {
        const size_t stride = tables == 2 ? LMP_SH_COUNT(bands) : LMP_SH_HALF_COUNT(bands);
        const size_t total = count_values(r, method, stride);
        vec4 *values = total < VALUES_MAX ? calloc(total + 1, sizeof *values) : NULL;
        if (!values || !fill_tables(r, method, bands, tables == 2, stride, values)) {
            free(values);
            return too_large(error);
        }
        glDeleteBuffers(1, &r->tables_buffer);
        glCreateBuffers(1, &r->tables_buffer);
        glNamedBufferStorage(r->tables_buffer, (GLsizeiptr)((total + 1) * sizeof *values), values,
                             0);
        r->tables_method = method;
        r->tables_bands = bands;
        free(values);
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_TABLES, r->tables_buffer);
    return true;
}

bool gpu_set_tables(gpu_renderer *r, const lmp_brdf_table *const *tables, int count,
                    const int *uses, cli_error *error) {
    if (!render_materials_set_tables(&r->materials, tables, count, uses, error))
        return false;
    gpu_set_preintegrated_brdfs(r, NULL);
    for (size_t i = 0; i < r->materials.count; i++)
        gpu_mesh_set_table(&r->mesh, i, uses[i]);
    return true;
}
