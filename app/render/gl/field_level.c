/* SPDX-License-Identifier: MIT */
/* field_level.c - buffers of a field, or of a coarser one, as shaders read it. */
#include "app/render/gl/field_level.h"

#include <stdlib.h>
#include <string.h>

size_t gpu_node_bytes(const lmp_field_desc *desc) {
    const size_t count = (size_t)desc->nodes[0] * (size_t)desc->nodes[1] * (size_t)desc->nodes[2];
    return count * 4 * 3 * LMP_SH_COUNT(desc->bands) * sizeof(float);
}

void gpu_reserve_nodes(gpu_field_level *level, size_t bytes) {
    if (level->bytes == bytes)
        return;
    gpu_texels_create(&level->nodes, bytes, NULL);
    level->bytes = bytes;
}

static shared_field describe(const lmp_field_info *info) {
    const lmp_field_desc *d = &info->desc;
    return (shared_field) {
        .origin = { d->origin.x, d->origin.y, d->origin.z, 1 / info->reach },
        .per_cell = { 1 / d->cell.x, 1 / d->cell.y, 1 / d->cell.z, (float)info->light_count },
        .cell = { d->cell.x, d->cell.y, d->cell.z, 0 },
        .nodes = { (float)d->nodes[0], (float)d->nodes[1], (float)d->nodes[2], 0 }
    };
}

/* Returns the most lights near any cell: those of its block, and those that are near everywhere. */
static size_t longest_list(const uint32_t *begin, size_t blocks) {
    size_t longest = 0;
    for (size_t i = 0; i < blocks; i++)
        longest = begin[i + 1] - begin[i] > longest ? begin[i + 1] - begin[i] : longest;
    return longest + begin[blocks + 1] - begin[blocks];
}

/* Uploads a field. The lights' ambient part is one more light for shaders, and also near
 * everywhere. */
bool gpu_upload_field(const gpu_context *context, const gpu_lights *lights, const lmp_field *field,
                      gpu_field_level *level) {
    const lmp_field_info info = lmp_field_describe(field);
    const int *n = info.desc.nodes;
    const size_t blocks = (size_t)(n[0] / 2) * (size_t)(n[1] / 2) * (size_t)(n[2] / 2);
    const size_t listed = lmp_field_copy_lists(field, 0, NULL, NULL), begins = blocks + 2;
    const size_t more = lights->shaded - info.light_count;
    const shared_field head = describe(&info);
    const size_t size = sizeof head + (begins + listed + 1) * sizeof(uint32_t);
    unsigned char *block = size <= context->storage_max ? calloc(1, size) : NULL;
    if (!block)
        return false;
    uint32_t *const begin = (uint32_t *)(void *)(block + sizeof head);
    memcpy(block, &head, sizeof head);
    lmp_field_copy_lists(field, listed + 1, begin, begin + begins);
    for (size_t i = 0; i < more; i++)
        begin[begins + listed + i] = (uint32_t)(info.light_count + i);
    begin[blocks + 1] += (uint32_t)more;
    level->longest = longest_list(begin, blocks);
    if (!level->block)
        glCreateBuffers(1, &level->block);
    glNamedBufferData(level->block, (GLsizeiptr)size, block, GL_DYNAMIC_DRAW);
    free(block);
    return true;
}
