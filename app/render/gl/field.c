/* SPDX-License-Identifier: MIT */
/* field.c - a field for shaders/program/field.glsl: its nodes, computed by the device or uploaded
 * when they have changed, and its lists of near lights. */
#include "app/render/gl/field.h"
#include "app/base/timing.h"

/* Nodes that a thread converts in one call. */
enum { RUN = 1024 };

void gpu_field_free(gpu_field *own) {
    for (int i = 0; i < GPU_FIELD_LEVELS; i++) {
        gpu_texels_free(&own->levels[i].nodes);
        glDeleteBuffers(1, &own->levels[i].block);
        own->levels[i] = (gpu_field_level) { 0 };
    }
    glDeleteBuffers(1, &own->staging);
    own->staging = 0;
    own->stamp = 0;
    glDeleteProgram(own->program);
    own->program = 0;
}

/* Allocates the buffer that the CPU writes nodes to. */
static void reserve_staging(gpu_field *own, size_t bytes) {
    if (own->staging && own->levels->bytes == bytes)
        return;
    glDeleteBuffers(1, &own->staging);
    glCreateBuffers(1, &own->staging);
    glNamedBufferStorage(own->staging, (GLsizeiptr)bytes, NULL,
                         GL_MAP_WRITE_BIT | GL_CLIENT_STORAGE_BIT);
}

static bool upload_nodes(gpu_field *own, const lmp_field *field, const lmp_field_desc *desc) {
    const size_t floats = 4 * 3 * LMP_SH_COUNT(desc->bands), bytes = gpu_node_bytes(desc);
    const size_t nodes = bytes / (floats * sizeof(float));
    reserve_staging(own, bytes);
    gpu_reserve_nodes(own->levels, bytes);
    float *texels = glMapNamedBufferRange(own->staging, 0, (GLsizeiptr)bytes,
                                          GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!texels)
        return false;
#pragma omp parallel for schedule(dynamic)
    for (size_t first = 0; first < nodes; first += RUN)
        lmp_field_copy_nodes(field, first, nodes - first < RUN ? nodes - first : RUN,
                             texels + first * floats);
    if (!glUnmapNamedBuffer(own->staging))
        return false;
    glCopyNamedBufferSubData(own->staging, own->levels->nodes.buffer, 0, 0, (GLsizeiptr)bytes);
    return true;
}

/* Brings the buffers up to date with a field that has changed. */
static bool take_field(gpu_field *own, const gpu_context *context, const gpu_lights *lights,
                       const lmp_field *field, base_error *error) {
    const lmp_field_desc desc = lmp_field_describe(field).desc;
    const size_t bytes = gpu_node_bytes(&desc);
    if (bytes > context->storage_max)
        return base_fail(error, NULL,
                         "a field of %zu MB: the device's buffers hold %zu (smaller --field-grid)",
                         bytes >> 20, context->storage_max >> 20);
    if (context->computes_fields)
        return gpu_compute_nodes(&own->program, own->levels, context, lights, field, error);
    return (upload_nodes(own, field, &desc) &&
            gpu_upload_field(context, lights, field, own->levels)) ||
           base_fail(error, NULL, "out of memory for a field");
}

bool gpu_field_bind(gpu_field *own, const gpu_context *context, const gpu_lights *lights,
                    const render_frame *frame, double *milliseconds, base_error *error) {
    const double start = timing_now();
    uint64_t stamp = 0;
    const lmp_field *field =
        frame->whole_field ? frame->whole_field(frame, !context->computes_fields, &stamp) : NULL;
    if (!field)
        return base_fail(error, NULL, "out of memory for a field");
    if (stamp != own->stamp) {
        own->stamp = 0;
        if (!take_field(own, context, lights, field, error))
            return false;
        own->stamp = stamp;
    }
    gpu_texels_bind(&own->levels->nodes, SHARED_FIELD_NODES);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD, own->levels->block);
    if (!milliseconds)
        return true;
    if (context->computes_fields)
        glFinish();
    *milliseconds = 1e3 * (timing_now() - start);
    return true;
}
