/* SPDX-License-Identifier: MIT */
/* field_nodes.c - computes the nodes of a field by shaders/program/field_nodes.comp, level by
 * level. */
#include "app/render/gl/field_nodes.h"
#include "app/render/gl/program.h"

#include <stdio.h>

/* Lights that a thread takes at once, and the iterations of its loops that result, of which
 * llvmpipe allows 65 535. */
enum { LIGHTS = 4096, TURNS = LIGHTS * (1 + LMP_FIELD_BANDS_MAX) };
static_assert(TURNS < 60000, "llvmpipe ends the loops");

/* Locations of the shader's uniforms. */
enum { BANDS, COARSEST, FIRST };

static bool compile(GLuint *program, base_error *error) {
    const gpu_stage compute = { GL_COMPUTE_SHADER, "field_nodes.comp" };
    char defines[64];
    if (*program)
        return true;
    snprintf(defines, sizeof defines, "#define LIGHTS %d\n#define COS_MIN %.9g\n", LIGHTS,
             (double)LMP_COS_MIN);
    *program = gpu_program(&compute, 1, defines, error);
    return *program;
}

/* Returns the number of threads per node. */
static int count_parts(int bands) {
    int count = 0;
    for (int m = 0; m < bands; m++)
        count += (bands - m + SHARED_FIELD_BANDS - 1) / SHARED_FIELD_BANDS;
    return count;
}

/* Computes the nodes of a level; for the coarsest field the lists are not read. */
static void compute_level(const gpu_field_level *own, const lmp_field *field) {
    const lmp_field_info info = lmp_field_describe(field);
    const bool coarsest = !lmp_field_coarser_level(field);
    const gpu_field_level *from = coarsest ? own : own + 1;
    const size_t count = coarsest ? info.light_count : from->longest;
    const int bands = info.desc.bands, parts = count_parts(bands), *n = info.desc.nodes;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_NODES, own->nodes.buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD, own->block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_COARSER_NODES, from->nodes.buffer);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_COARSER, from->block);
    glUniform1i(BANDS, bands);
    glUniform1i(COARSEST, coarsest);
    for (size_t first = 0; first == 0 || first < count; first += LIGHTS) {
        glUniform1i(FIRST, (GLint)first);
        glDispatchCompute((GLuint)(parts * ((n[0] + 3) / 4)), (GLuint)(n[1] + 3) / 4,
                          (GLuint)(n[2] + 3) / 4);
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
}

bool gpu_compute_nodes(GLuint *program, gpu_field_level levels[GPU_FIELD_LEVELS],
                       const gpu_context *context, const gpu_lights *lights, const lmp_field *field,
                       base_error *error) {
    const lmp_field *fields[GPU_FIELD_LEVELS];
    int count = 0;
    if (!compile(program, error))
        return false;
    for (; field && count < GPU_FIELD_LEVELS; field = lmp_field_coarser_level(field), count++) {
        const lmp_field_desc desc = lmp_field_describe(field).desc;
        fields[count] = field;
        gpu_reserve_nodes(&levels[count], gpu_node_bytes(&desc));
        if (!gpu_upload_field(context, lights, field, &levels[count]))
            return base_fail(error, NULL, "out of memory for a field");
    }
    glUseProgram(*program);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, lights->block);
    for (int level = count - 1; level >= 0; level--)
        compute_level(&levels[level], fields[level]);
    return true;
}
