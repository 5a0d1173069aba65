/* SPDX-License-Identifier: MIT */
/* Tables of BRDFs for shaders/table.glsl. */
#include "app/gpu/internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows and columns that linear interpolation reads. */
enum { ROWS = 1024, ANISOTROPIC_ROWS = 192, COLUMNS_OF_AZIMUTH = 4 };

typedef struct resampled {
    size_t rows, columns;
} resampled;

static resampled shape_of(const lmp_brdf_table_info *info) {
    if (info->azimuths == 1)
        return (resampled) { ROWS, 1 };
    return (resampled) { ANISOTROPIC_ROWS, (size_t)(COLUMNS_OF_AZIMUTH * info->azimuths) };
}

/* One view as vec4s in the order of the shader. */
static void fill_view(const lmp_brdf_table_info *info, bool full, const float *rgb, vec4 *to) {
    for (int l = 0; l < info->bands; l++)
        for (int m = full ? -l : 0; m <= l; m++, to++)
            for (size_t c = 0; c < 3; c++) {
                const size_t i = (size_t)(info->mirrored ? l * (l + 1) / 2 + m : l * l + l + m);
                (*to)[c] = info->mirrored && m < 0 ? 0 : rgb[c * info->count + i];
            }
}

static bool fill_table(const lmp_brdf_table *table, bool full, size_t stride, vec4 *values) {
    const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
    const resampled shape = shape_of(&info);
    float *rgb = malloc(3 * info.count * sizeof *rgb);
    if (!rgb)
        return false;
    for (size_t column = 0; column < shape.columns; column++)
        for (size_t row = 0; row < shape.rows; row++, values += stride) {
            const double theta = 1.5707963267949 * (double)row / (double)(shape.rows - 1);
            const double phi = 6.2831853071796 * (double)column / (double)shape.columns;
            lmp_brdf_table_view(table, (float)cos(theta), (float)phi, rgb);
            fill_view(&info, full, rgb, values);
        }
    free(rgb);
    return true;
}

static bool fill_tables(const gpu_renderer *r, size_t stride, size_t total, vec4 *values) {
    size_t first = (size_t)r->table_count;
    for (int t = 0; t < r->table_count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(r->tables[t]);
        const resampled shape = shape_of(&info);
        values[t][0] = (float)first;
        values[t][1] = (float)shape.rows;
        values[t][2] = (float)shape.columns;
        if (!fill_table(r->tables[t], r->tables_full, stride, values + first))
            return false;
        first += shape.rows * shape.columns * stride;
    }
    return first == total;
}

bool gpu_set_tables(gpu_renderer *r, const lmp_brdf_table *const *tables, int count,
                    const int *uses, size_t material_count, cli_error *error) {
    if (count > GPU_TABLES_MAX)
        return cli_fail(error, NULL, "%d materials with tables: the shaders take %d", count,
                        GPU_TABLES_MAX);
    r->table_count = count;
    r->tables_full = false;
    for (int t = 0; t < count; t++) {
        r->tables[t] = tables[t];
        r->tables_full |= !lmp_brdf_table_describe(tables[t]).mirrored;
    }
    size_t total = (size_t)count, stride = 0;
    for (int t = 0; t < count; t++) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(tables[t]);
        const size_t n = (size_t)info.bands;
        const resampled shape = shape_of(&info);
        if (stride && info.bands != r->table_bands)
            return cli_fail(error, NULL, "tables of %d and of %d bands in one picture",
                            r->table_bands, info.bands);
        r->table_bands = info.bands;
        stride = r->tables_full ? n * n : n * (n + 1) / 2;
        total += shape.rows * shape.columns * stride;
    }
    vec4 *values = total < (size_t)1 << 23 ? calloc(total + 1, sizeof *values) : NULL;
    const bool ok = values && fill_tables(r, stride, total, values);
    gpu_forget_geometry(r);
    if (ok) {
        glDeleteBuffers(1, &r->tables_buffer);
        glCreateBuffers(1, &r->tables_buffer);
        glNamedBufferStorage(r->tables_buffer, (GLsizeiptr)((total + 1) * sizeof *values), values,
                             0);
        for (size_t i = 0; i < material_count; i++)
            gpu_mesh_set_kind(&r->mesh, i,
                              uses[i] < 0 ? SHARED_KIND_SURFACE : SHARED_KIND_TABLE + uses[i]);
    }
    free(values);
    return ok || cli_fail(error, NULL, "the tables of the materials are too large (fewer --bands)");
}
