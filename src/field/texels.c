/* SPDX-License-Identifier: MIT */
/* texels.c - a field as shaders read it: nodes in the order of the grid, and the lists of near
 * lights one after another. */
#include "src/field/grid.h"

void lmp_field_copy_nodes(const lmp_field *field, size_t first, size_t count, float *texels) {
    const int *n = field->info.desc.nodes;
    const size_t x = (size_t)n[0], y = (size_t)n[1], all = x * y * (size_t)n[2];
    const size_t stride = field->stride, values = field->values;
    assert(first <= all && count <= all - first);
    (void)all;
    for (size_t i = first; i < first + count; i++) {
        const uint32_t at =
            lmpi_field_node(field, (uint32_t)(i % x), (uint32_t)(i / x % y), (uint32_t)(i / x / y));
        const float *node = field->nodes + 4 * stride * at;
        for (size_t v = 0; v < values; v++, texels += 4) {
            texels[0] = node[v];
            texels[1] = node[stride + v];
            texels[2] = node[2 * stride + v];
            texels[3] = node[3 * stride + v];
        }
    }
}

size_t lmp_field_copy_lists(const lmp_field *field, size_t capacity, uint32_t *begin,
                            uint32_t *lights) {
    size_t count = 0;
    for (size_t list = 0; list <= field->block_count; list++) {
        if (capacity > 0)
            begin[list] = (uint32_t)count;
        for (uint32_t at = field->lists[list]; at != FIELD_NONE; at = field->entries[at].next) {
            const field_entry *entry = &field->entries[at];
            for (uint32_t i = 0; i < entry->count; i++, count++)
                if (count < capacity)
                    lights[count] = entry->lights[i];
        }
    }
    if (capacity > 0)
        begin[field->block_count + 1] = (uint32_t)count;
    return count;
}

const lmp_field *lmp_field_coarser_level(const lmp_field *field) {
    return field->coarse;
}
