/* SPDX-License-Identifier: MIT */
/* placed.h - instances for scenes that a test makes by hand, whose meshes stand where they are. */
#ifndef LAMPION_TESTS_PLACED_H
#define LAMPION_TESTS_PLACED_H

#include "app/scene/instance.h"

/* Returns an instance of each of the first meshes, the same array for all callers; NULL if there
 * are not enough. */
static inline const scene_instance *placed_meshes(size_t count) {
    enum { MOST = 256 };
    static scene_instance all[MOST];
    for (uint32_t i = 0; i < MOST; i++)
        all[i] = scene_instance_identity(i);
    return count <= MOST ? all : NULL;
}

#endif
