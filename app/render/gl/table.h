/* SPDX-License-Identifier: MIT */
/* table.h - tables of BRDFs where shaders read them. */
#ifndef LAMPION_RENDER_GL_TABLE_H
#define LAMPION_RENDER_GL_TABLE_H

#include "app/render/gl/texels.h"
#include "app/render/materials.h"
#include "app/render/method.h"
#include "app/scene/environment.h"
#include "shaders/program/shared.h"

/* The tables that are summed by bands; all 0: none. */
typedef struct gpu_tables {
    gpu_texels values;
    method_kind method; /* for which it was made */
    int bands;          /* for which it was made */
} gpu_tables;

/* The layout of a table's views as the shader reads them: rows by polar angle, columns by azimuth,
 * `stride` values per view; mirror-symmetric tables store half the coefficients unless `full`. */
typedef struct gpu_table_shape {
    size_t rows, columns;
} gpu_table_shape;
bool gpu_table_fill(const lmp_brdf_table *table, gpu_table_shape shape, int bands, bool full,
                    size_t stride, vec4 *values);

/* Returns which tables frames of a method sum by bands: 0 none, 1 mirror-symmetric ones, 2 any. */
int gpu_tables_by_bands(const render_materials *materials, const environment *around,
                        method_kind method);

/* Checks before tables are made whether tables with these properties fit. */
bool gpu_tables_would_fit(const environment *around, method_kind method,
                          const lmp_brdf_table_info *tables, int count, base_error *error);

/* Binds the tables that a frame of so many bands sums by bands, uploaded once; bands that a table
 * lacks are 0. */
bool gpu_tables_bind(gpu_tables *uploaded, const render_materials *materials,
                     const environment *around, method_kind method, int bands, base_error *error);

/* Frees the uploaded tables, which are then uploaded again when needed. */
void gpu_tables_free(gpu_tables *uploaded);

#endif
