/* SPDX-License-Identifier: MIT */
/* load.h - loads a scene that a test needs, past the cache. */
#ifndef LAMPION_PROGRAM_LOAD_H
#define LAMPION_PROGRAM_LOAD_H

#include "app/scene/scene.h"
#include "tests/oracle/check.h"

#include <math.h>

static inline scene load(const char *name) {
    scene loaded;
    base_error error = { 0 };
    if (!scene_load(name, &(scene_options) { .no_cache = true }, &loaded, &error))
        fail_msg("%s", error.text);
    return loaded;
}

/* Asserts unit normals, tangents perpendicular to them, and indices of vertices that exist. */
static inline void assert_unit_and_inside(const scene *s) {
    for (size_t i = 0; i < s->index_count; i++)
        assert_true(s->indices[i] < s->vertex_count);
    for (size_t i = 0; i < s->vertex_count; i++) {
        const float *n = s->vertices[i].normal, *t = s->vertices[i].tangent;
        CHECK_WITHIN(fabsf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1), 1e-5);
        CHECK_WITHIN(fabsf(t[0] * t[0] + t[1] * t[1] + t[2] * t[2] - 1), 1e-5);
        CHECK_WITHIN(fabsf(n[0] * t[0] + n[1] * t[1] + n[2] * t[2]), 1e-3);
        assert_true(fabsf(t[3]) == 1);
    }
}

#endif
