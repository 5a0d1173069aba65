/* SPDX-License-Identifier: MIT */
/* field.c - a field for shaders/field.glsl: its nodes and its lists of near lights, uploaded when
 * they have changed. */
#include "app/gpu/internal.h"
#include "app/timing/timing.h"

#include <lampion/field.h>

#include <stdlib.h>
#include <string.h>

/* Nodes that a thread takes at once. */
enum { RUN = 1024 };

static size_t count_nodes(const lmp_field_desc *desc) {
    return (size_t)desc->nodes[0] * (size_t)desc->nodes[1] * (size_t)desc->nodes[2];
}

static size_t texel_floats(const lmp_field_desc *desc) {
    return 4 * 3 * LMP_SH_COUNT(desc->bands);
}

void gpu_forget_field(gpu_renderer *r) {
    glDeleteBuffers(1, &r->field_nodes);
    glDeleteBuffers(1, &r->field_staging);
    glDeleteBuffers(1, &r->field_block);
    r->field_nodes = r->field_staging = r->field_block = 0;
    r->field_bytes = 0;
    r->field_stamp = 0;
}

/* Room for the nodes where shaders read them, and where the host writes them. */
static void reserve_nodes(gpu_renderer *r, size_t bytes) {
    if (r->field_bytes == bytes)
        return;
    gpu_forget_field(r);
    glCreateBuffers(1, &r->field_nodes);
    glNamedBufferStorage(r->field_nodes, (GLsizeiptr)bytes, NULL, 0);
    glCreateBuffers(1, &r->field_staging);
    glNamedBufferStorage(r->field_staging, (GLsizeiptr)bytes, NULL,
                         GL_MAP_WRITE_BIT | GL_CLIENT_STORAGE_BIT);
    r->field_bytes = bytes;
}

static bool upload_nodes(gpu_renderer *r, const lmp_field *field, const lmp_field_desc *desc) {
    const size_t nodes = count_nodes(desc), floats = texel_floats(desc);
    const size_t bytes = nodes * floats * sizeof(float);
    reserve_nodes(r, bytes);
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
    glCopyNamedBufferSubData(r->field_staging, r->field_nodes, 0, 0, (GLsizeiptr)bytes);
    return true;
}

static shared_field describe(const lmp_field_info *info) {
    const lmp_field_desc *d = &info->desc;
    return (shared_field) { .origin = { d->origin.x, d->origin.y, d->origin.z, 1 / info->reach },
                            .per_cell = { 1 / d->cell.x, 1 / d->cell.y, 1 / d->cell.z, 0 },
                            .cell = { d->cell.x, d->cell.y, d->cell.z, 0 },
                            .nodes = { (float)d->nodes[0], (float)d->nodes[1], (float)d->nodes[2],
                                       0 } };
}

/* What is ambient in the lights is one more of the shaders' lights: it is near everywhere, too. */
static bool upload_lists(gpu_renderer *r, const lmp_field *field, const lmp_field_info *info) {
    const int *n = info->desc.nodes;
    const size_t blocks = (size_t)(n[0] / 2) * (size_t)(n[1] / 2) * (size_t)(n[2] / 2);
    const size_t listed = lmp_field_lists(field, 0, NULL, NULL), begins = blocks + 2;
    const size_t more = r->shaded_lights - info->light_count;
    const shared_field head = describe(info);
    const size_t size = sizeof head + (begins + listed + 1) * sizeof(uint32_t);
    unsigned char *block = calloc(1, size);
    if (!block)
        return false;
    uint32_t *const begin = (uint32_t *)(void *)(block + sizeof head);
    memcpy(block, &head, sizeof head);
    lmp_field_lists(field, listed + 1, begin, begin + begins);
    for (size_t i = 0; i < more; i++)
        begin[begins + listed + i] = (uint32_t)(info->light_count + i);
    begin[blocks + 1] += (uint32_t)more;
    if (!r->field_block)
        glCreateBuffers(1, &r->field_block);
    glNamedBufferData(r->field_block, (GLsizeiptr)size, block, GL_DYNAMIC_DRAW);
    free(block);
    return true;
}

bool gpu_bind_field(gpu_renderer *r, const gpu_frame *frame, double *milliseconds,
                    cli_error *error) {
    const double start = timing_now();
    uint64_t stamp = 0;
    const lmp_field *field = frame->whole_field ? frame->whole_field(frame, &stamp) : NULL;
    if (!field)
        return cli_fail(error, NULL, "out of memory for a field");
    const lmp_field_info info = lmp_field_describe(field);
    const size_t bytes = count_nodes(&info.desc) * texel_floats(&info.desc) * sizeof(float);
    if (bytes > r->context.storage_max)
        return cli_fail(error, NULL,
                        "a field of %zu MB: the device's buffers hold %zu (smaller --field-grid)",
                        bytes >> 20, r->context.storage_max >> 20);
    if (stamp != r->field_stamp &&
        (!upload_nodes(r, field, &info.desc) || !upload_lists(r, field, &info)))
        return cli_fail(error, NULL, "out of memory for a field");
    r->field_stamp = stamp;
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD_NODES, r->field_nodes);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, SHARED_FIELD, r->field_block);
    *milliseconds = 1e3 * (timing_now() - start);
    return true;
}
