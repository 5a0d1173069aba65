/* SPDX-License-Identifier: MIT */
/* tree.h - Embree's trees of a scene's triangles: one over all instances, and one of each mesh that
 * several of them show. */
#ifndef LAMPION_TRACE_TREE_H
#define LAMPION_TRACE_TREE_H

#include "app/scene/instance.h"
#include "app/trace/rays.h"

#include <embree3/rtcore.h>

/* Positions of a triangle, side by side: a test reads one cache line, or two, where the scene's
 * indices and vertices lie on four. */
typedef struct trace_corner_set {
    float of[3][3];
} trace_corner_set;

/* What the test reads of an instance. */
typedef struct trace_instance {
    const trace_corner_set *corners; /* of its triangles */
    const scene_instance *placed;
    const scene_material *material;
    bool moves, mirrors; /* the corners are the mesh's, which it moves, or whose sides it changes */
} trace_instance;

/* A geometry of Embree's: a mesh that one instance alone has, in the world; or one of several, in
 * its own space, which has a tree of its own. */
typedef struct trace_mesh {
    const trace_bvh *bvh;
    const scene_mesh *mesh;
    uint32_t uses, instance;   /* instances, and the last of them */
    trace_corner_set *corners; /* in its own space; of one instance, in the world */
    float margin;              /* of its triangles' bounds */
    RTCScene tree;             /* of more than one instance */
} trace_mesh;

struct trace_bvh {
    const scene *scene;
    trace_mesh *meshes;
    trace_instance *instances;
    trace_corner_set *corners; /* of all meshes */
    RTCDevice device;
    RTCScene rays;
    RTCIntersectFunctionN test;
};

/* Builds the trees of a scene into a zeroed *bvh; geometries have the numbers of their instances.
 * False without memory. */
bool tree_build(trace_bvh *bvh, const scene *scene, RTCIntersectFunctionN test);

/* Frees what it holds. */
void tree_free(trace_bvh *bvh);

/* The positions of a triangle's corners in the world; those of an instance that moves its mesh are
 * computed into `moved`. */
static inline void tree_corners(const trace_instance *instance, uint32_t triangle,
                                float moved[3][3], const float *corners[3]) {
    const trace_corner_set *set = &instance->corners[triangle];
    for (int i = 0; i < 3; i++) {
        corners[i] = set->of[instance->mirrors && i > 0 ? 3 - i : i];
        if (instance->moves) {
            scene_instance_point(instance->placed, corners[i], moved[i]);
            corners[i] = moved[i];
        }
    }
}

#endif
