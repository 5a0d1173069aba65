/* SPDX-License-Identifier: MIT */
/* tree.h - Embree's trees of a scene's triangles: one over all instances, and one for each mesh
 * that several instances show. */
#ifndef LAMPION_SCENE_TRACE_TREE_H
#define LAMPION_SCENE_TRACE_TREE_H

#include "app/scene/instance.h"
#include "app/scene/trace/rays.h"

#include <embree3/rtcore.h>

/* Positions of a triangle side by side: a test reads one or two cache lines, instead of four in the
 * scene's indices and vertices. */
typedef struct trace_corner_set {
    float of[3][3];
} trace_corner_set;

/* The data of an instance that the test reads. */
typedef struct trace_instance {
    const trace_corner_set *corners; /* of its triangles */
    const uint32_t *groups;          /* of its mesh */
    const scene_instance *placed;
    const scene_material *material;
    bool moves, mirrors; /* whether the instance moves its mesh, and whether it swaps its sides */
} trace_instance;

/* Consecutive triangles form one of Embree's primitives where they lie close together, as the
 * halves of a quad do: most rays that meet the bounds of one meet those of the others. */
enum { TREE_GROUP = 4 };

/* A geometry of Embree: a mesh in the world if it has one instance; otherwise a mesh in its own
 * space, with a tree of its own. */
typedef struct trace_mesh {
    const trace_bvh *bvh;
    const scene_mesh *mesh;
    uint32_t uses, instance;   /* number of instances, and the last of them */
    trace_corner_set *corners; /* in the mesh's own space or, with one instance, in the world */
    uint32_t *groups;          /* the first triangle of each group, then the number of triangles */
    uint32_t group_count;
    float margin;  /* by which bounds are widened */
    RTCScene tree; /* of a mesh with several instances */
} trace_mesh;

struct trace_bvh {
    const scene *scene;
    trace_mesh *meshes;
    trace_instance *instances;
    trace_corner_set *corners; /* of all meshes */
    uint32_t *groups;          /* of all meshes */
    RTCDevice device;
    RTCScene rays;
    RTCIntersectFunctionN intersect; /* tests of a group, for the nearest hit and for any */
    RTCOccludedFunctionN occlude;
};

/* Builds the trees of a scene into a zeroed *bvh; geometries have the numbers of their instances.
 * Returns false if memory ran out. */
bool tree_build(trace_bvh *bvh, const scene *scene, RTCIntersectFunctionN intersect,
                RTCOccludedFunctionN occlude);

/* Frees the trees and arrays. */
void tree_free(trace_bvh *bvh);

/* Returns the positions of a triangle's corners in the world; those of an instance that moves its
 * mesh are computed into `moved`. */
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
