/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/planes.h"

#include "app/base/memory.h"

#include <stdlib.h>

void shadow_planes_free(shadow_planes *p) {
    free(p->memory);
    *p = (shadow_planes) { .memory = NULL };
}

bool shadow_planes_resize(shadow_planes *p, int width, int height, int sets) {
    const size_t count = (size_t)width * (size_t)height;
    if (p->memory && p->width == width && p->height == height && p->sets == sets)
        return true;
    shadow_planes_free(p);
    const size_t planes = 7 + (size_t)(sets + 1) * SHADOW_VALUES;
    float *next = p->memory = memory_large(planes * count * sizeof *next);
    if (!next)
        return false;
    p->width = width;
    p->height = height;
    p->sets = sets;
    for (int c = 0; c < 3; c++, next += 2 * count) {
        p->position[c] = next;
        p->normal[c] = next + count;
    }
    p->footprint = next;
    next += count;
    for (int i = 0; i < SHADOW_VALUES; i++, next += count)
        p->scratch[i] = next;
    for (int set = 0; set < sets; set++)
        for (int i = 0; i < SHADOW_VALUES; i++, next += count)
            p->values[set][i] = next;
    return true;
}
