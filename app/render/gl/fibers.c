/* SPDX-License-Identifier: MIT */
/* The pass before shading that draws the sheen of materials (shaders/fibers.comp). */
#include "app/render/gl/internal.h"

#include <stdio.h>
#include <stdlib.h>

/* Rows that linear interpolation reads of a table: fibers are smooth. */
enum { ROWS = 256 };

static_assert(SHARED_FIBER_TABLES == LMP_FIBER_TABLES, "shared.h has the numbers of lmp_fibers");

void gpu_set_fibers(gpu_renderer *r, const lmp_brdf_table *const *white) {
    r->materials.fibers = white;
    glDeleteBuffers(1, &r->fibers_buffer);
    r->fibers_buffer = 0;
}

bool gpu_shades_fibers(const gpu_renderer *r, const render_frame *frame) {
    return r->materials.fibers && !frame->host && !method_table[frame->method].fragment &&
           render_materials_sheens(&r->materials) > 0;
}

/* One vector a table, then their values. */
static bool upload(gpu_renderer *r, int bands, cli_error *error) {
    const size_t stride = LMP_SH_HALF_COUNT(bands);
    const size_t total = LMP_FIBER_TABLES * (1 + ROWS * stride);
    vec4 *values = calloc(total, sizeof *values);
    bool ok = values;
    for (size_t t = 0; ok && t < LMP_FIBER_TABLES; t++) {
        const size_t first = LMP_FIBER_TABLES + t * ROWS * stride;
        values[t][0] = (float)first;
        values[t][1] = ROWS;
        values[t][2] = 1;
        ok = gpu_table_fill(r->materials.fibers[t], (gpu_table_shape) { ROWS, 1 }, bands, false,
                            stride, values + first);
    }
    if (ok) {
        glCreateBuffers(1, &r->fibers_buffer);
        glNamedBufferStorage(r->fibers_buffer, (GLsizeiptr)(total * sizeof *values), values, 0);
    }
    free(values);
    return ok || cli_fail(error, NULL, "out of memory");
}

bool gpu_prepare_fibers(gpu_renderer *r, const render_frame *frame, cli_error *error) {
    if (!gpu_shades_fibers(r, frame))
        return true;
    const gpu_stage compute = { GL_COMPUTE_SHADER, "fibers.comp" };
    const int bands = lmp_brdf_table_describe(r->materials.fibers[0]).bands;
    const int environment_bands = gpu_reflected_bands(r, bands);
    const bool by_field =
        method_table[frame->method].reads & METHOD_READS_FIELD && bands == frame->bands;
    if (!r->fibers_buffer && !upload(r, bands, error))
        return false;
    if (r->fibers_program && r->fibers_bands == bands && r->fibers_by_field == by_field &&
        r->fibers_environment_bands == environment_bands)
        return true;
    char defines[96];
    snprintf(defines, sizeof defines, "#define LMP_BANDS %d\n#define TABLE_ENVIRONMENT %d\n%s",
             bands, environment_bands, by_field ? "#define SHADE_FIELD\n" : "");
    glDeleteProgram(r->fibers_program);
    r->fibers_program = gpu_program(&compute, 1, defines, error);
    r->fibers_bands = bands;
    r->fibers_environment_bands = environment_bands;
    r->fibers_by_field = by_field;
    return r->fibers_program;
}
