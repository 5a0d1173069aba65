/* SPDX-License-Identifier: MIT */
/* field.c - a field for shaders/field.glsl: its nodes, computed there or uploaded when they have
 * changed, and its lists of near lights. */
#include "app/render/gl/internal.h"
#include "app/timing/timing.h"

/* Nodes that a thread takes at once. */
enum { RUN = 1024 };

void gpu_forget_field(gpu_renderer *r) {
    for (int i = 0; i < GPU_FIELD_LEVELS; i++) {
        glDeleteBuffers(1, &r->field[i].nodes);
        glDeleteBuffers(1, &r->field[i].block);
        r->field[i] = (gpu_field_level) { 0 };
    }
    glDeleteBuffers(1, &r->field_staging);
    r->field_staging = 0;
    r->field_stamp = 0;
}

/* Room where the host writes them. */
static void reserve_staging(gpu_renderer *r, size_t bytes) {
    if (r->field_staging && r->field->bytes == bytes)
        return;
    glDeleteBuffers(1, &r->field_staging);
    glCreateBuffers(1, &r->field_staging);
    glNamedBufferStorage(r->field_staging, (GLsizeiptr)bytes, NULL,
                         GL_MAP_WRITE_BIT | GL_CLIENT_STORAGE_BIT);
}

static bool upload_nodes(gpu_renderer *r, const lmp_field *field, const lmp_field_desc *desc) {
    const size_t floats = 4 * 3 * LMP_SH_COUNT(desc->bands), bytes = gpu_node_bytes(desc);
    const size_t nodes = bytes / (floats * sizeof(float));
    reserve_staging(r, bytes);
    gpu_reserve_nodes(r->field, bytes);
    float *texels = glMapNamedBufferRange(r->field_staging, 0, (GLsizeiptr)bytes,
                                          GL_MAP_WRITE_BIT | GL_MAP_INVALIDATE_BUFFER_BIT);
    if (!texels)
        return false;
#pragma omp parallel for schedule(dynamic)
    for (size_t first = 0; first < nodes; first += RUN)
        lmp_field_nodes(field, first, nodes - first < RUN ? nodes - first : RUN,
                        texels + first * floats);
    if (!glUnmapNamedBuffer(r->field_staging))
        return false;
    glCopyNamedBufferSubData(r->field_staging, r->field->nodes, 0, 0, (GLsizeiptr)bytes);
    return true;
}

/* As it is now, in the buffers. */
static bool take_field(gpu_renderer *r, const lmp_field *field, cli_error *error) {
    const lmp_field_desc desc = lmp_field_describe(field).desc;
    const size_t bytes = gpu_node_bytes(&desc);
    if (bytes > r->context.storage_max)
        return cli_fail(error, NULL,
                        "a field of %zu MB: the device's buffers hold %zu (smaller --field-grid)",
                        bytes >> 20, r->context.storage_max >> 20);
    if (r->context.computes_fields)
        return gpu_compute_nodes(r, field, error);
    return (upload_nodes(r, field, &desc) && gpu_upload_field(r, field, r->field)) ||
           cli_fail(error, NULL, "out of memory for a field");
}

bool gpu_bind_field(gpu_renderer *r, const render_frame *frame, double *milliseconds,
                    cli_error *error) {
    const double start = timing_now();
    uint64_t stamp = 0;
    const lmp_field *field =
        frame->whole_field ? frame->whole_field(frame, !r->context.computes_fields, &stamp) : NULL;
    if (!field)
        return cli_fail(error, NULL, "out of memory for a field");
    if (stamp != r->field_stamp) {
        r->field_stamp = 0;
        if (!take_field(r, field, error))
            return false;
        r->field_stamp = stamp;
    }
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_NODES, r->field->nodes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD, r->field->block);
    if (!milliseconds)
        return true;
    if (r->context.computes_fields)
        glFinish();
    *milliseconds = 1e3 * (timing_now() - start);
    return true;
}
