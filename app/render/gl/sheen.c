/* SPDX-License-Identifier: MIT */
/* The pass before shading that draws the sheen of materials (shaders/program/sheen.comp). */
#include "app/render/gl/sheen.h"
#include "app/render/gl/program.h"
#include "app/render/gl/table.h"

#include <stdio.h>
#include <stdlib.h>

/* Rows of a table, between which shaders interpolate: sheen is smooth. */
enum { ROWS = 256 };

static_assert(SHARED_SHEEN_TABLES == LMP_SHEEN_TABLES,
              "shared.h has the numbers of lmp_sheen_layer");

void gpu_sheen_forget(gpu_sheen *own) {
    gpu_texels_free(&own->tables);
}

void gpu_sheen_free(gpu_sheen *own) {
    gpu_sheen_forget(own);
    glDeleteProgram(own->program);
}

bool gpu_sheen_shade(const render_materials *materials, const render_frame *frame) {
    return materials->sheen_tables[0] && !frame->cpu_shader &&
           !method_table[frame->method].fragment && render_materials_sheens(materials) > 0;
}

/* Uploads one vector per table, then the tables' values. */
static bool upload(gpu_sheen *own, const render_materials *materials, int bands,
                   base_error *error) {
    const size_t stride = LMP_SH_HALF_COUNT(bands);
    const size_t total = LMP_SHEEN_TABLES * (1 + ROWS * stride);
    vec4 *values = calloc(total, sizeof *values);
    bool ok = values;
    for (size_t t = 0; ok && t < LMP_SHEEN_TABLES; t++) {
        const size_t first = LMP_SHEEN_TABLES + t * ROWS * stride;
        values[t][0] = (float)first;
        values[t][1] = ROWS;
        values[t][2] = 1;
        ok = gpu_table_fill(materials->sheen_tables[t], (gpu_table_shape) { ROWS, 1 }, bands, false,
                            stride, values + first);
    }
    if (ok)
        gpu_texels_create(&own->tables, total * sizeof *values, values);
    free(values);
    return ok || base_fail(error, NULL, "out of memory");
}

bool gpu_sheen_prepare(gpu_sheen *own, const gpu_context *context,
                       const render_materials *materials, const gpu_environment *around,
                       const render_frame *frame, base_error *error) {
    if (!gpu_sheen_shade(materials, frame))
        return true;
    const gpu_stage compute = { GL_COMPUTE_SHADER, "sheen.comp" };
    const int bands = lmp_brdf_table_describe(materials->sheen_tables[0]).bands;
    const int environment_bands = gpu_environment_reflected(around, bands);
    const bool by_field =
        method_table[frame->method].reads & METHOD_READS_FIELD && bands == frame->bands;
    if (!own->tables.buffer && !upload(own, materials, bands, error))
        return false;
    if (own->program && own->bands == bands && own->by_field == by_field &&
        own->environment_bands == environment_bands)
        return true;
    char defines[128];
    snprintf(defines, sizeof defines, "%s#define LMP_BANDS %d\n#define TABLE_ENVIRONMENT %d\n%s",
             gpu_texels_define(context), bands, environment_bands,
             by_field ? "#define SHADE_FIELD\n" : "");
    glDeleteProgram(own->program);
    own->program = gpu_program(&compute, 1, defines, error);
    own->bands = bands;
    own->environment_bands = environment_bands;
    own->by_field = by_field;
    return own->program;
}
