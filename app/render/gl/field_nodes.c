/* SPDX-License-Identifier: MIT */
/* field_nodes.c - the nodes of a field by shaders/field_nodes.comp, level by level. */
#include "app/render/gl/internal.h"

#include <stdio.h>

/* Lights that a thread takes at once, and so turns of its loops, of which llvmpipe has 65 535. */
enum { LIGHTS = 4096, TURNS = LIGHTS * (1 + LMP_FIELD_BANDS_MAX) };
static_assert(TURNS < 60000, "llvmpipe ends the loops");

/* Uniforms, as the shader has them. */
enum { BANDS, COARSEST, FIRST };

static bool compile(gpu_renderer *r, cli_error *error) {
    const gpu_stage compute = { GL_COMPUTE_SHADER, "field_nodes.comp" };
    char defines[64];
    if (r->field_program)
        return true;
    snprintf(defines, sizeof defines, "#define LIGHTS %d\n#define COS_MIN %.9g\n", LIGHTS,
             (double)LMP_COS_MIN);
    r->field_program = gpu_program(&compute, 1, defines, error);
    return r->field_program;
}

/* Threads of a node. */
static int count_parts(int bands) {
    int count = 0;
    for (int m = 0; m < bands; m++)
        count += (bands - m + SHARED_FIELD_BANDS - 1) / SHARED_FIELD_BANDS;
    return count;
}

/* Of the coarsest field the lists are not read. */
static void compute_level(const gpu_renderer *r, const lmp_field *field, int level) {
    const lmp_field_info info = lmp_field_describe(field);
    const bool coarsest = !lmp_field_coarser(field);
    const gpu_field_level *own = &r->field[level], *from = coarsest ? own : own + 1;
    const size_t count = coarsest ? info.light_count : from->longest;
    const int bands = info.desc.bands, parts = count_parts(bands), *n = info.desc.nodes;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_NODES, own->nodes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD, own->block);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_COARSER_NODES, from->nodes);
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

bool gpu_compute_nodes(gpu_renderer *r, const lmp_field *field, cli_error *error) {
    const lmp_field *levels[GPU_FIELD_LEVELS];
    int count = 0;
    if (!compile(r, error))
        return false;
    for (; field && count < GPU_FIELD_LEVELS; field = lmp_field_coarser(field), count++) {
        const lmp_field_desc desc = lmp_field_describe(field).desc;
        levels[count] = field;
        gpu_reserve_nodes(&r->field[count], gpu_node_bytes(&desc));
        if (!gpu_upload_field(r, field, &r->field[count]))
            return cli_fail(error, NULL, "out of memory for a field");
    }
    glUseProgram(r->field_program);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_LIGHTS, r->lights_block);
    for (int level = count - 1; level >= 0; level--)
        compute_level(r, levels[level], level);
    return true;
}
