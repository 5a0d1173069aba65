/* SPDX-License-Identifier: MIT */
/* rays.h - rays and their hits. */
#ifndef LAMPION_SCENE_TRACE_RAYS_H
#define LAMPION_SCENE_TRACE_RAYS_H

#include "app/scene/scene.h"

#include <math.h>

typedef struct trace_bvh trace_bvh;

/* Which triangles stop a ray. */
typedef enum trace_kind {
    TRACE_CAMERA, /* triangles seen from a side that is drawn */
    TRACE_LIGHT   /* all triangles */
} trace_kind;

/* Rays side by side; lanes of length < 0 hold no ray. */
#define TRACE_LANES 16
typedef struct trace_rays {
    float origin[3][TRACE_LANES], direction[3][TRACE_LANES];
    float start[TRACE_LANES],
        length[TRACE_LANES]; /* in lengths of the direction; a hit lies beyond start */
    bool together;           /* for TRACE_LIGHT: the rays have nearly the same direction */
} trace_rays;

#define TRACE_NOTHING UINT32_MAX
typedef struct trace_hit {
    float distance;    /* in lengths of the direction; INFINITY if nothing is hit */
    uint32_t instance; /* or TRACE_NOTHING, and the rest is not set */
    uint32_t triangle; /* of the instance */
    float u, v;        /* weights of its second and third corner */
} trace_hit;

static inline trace_hit trace_miss(void) {
    return (trace_hit) { .distance = INFINITY, .instance = TRACE_NOTHING };
}

/* Returns how far off any surface a ray must start so that rounding does not make it hit that
 * surface. */
double trace_lift(const scene *scene);

static inline float trace_largest(lmp_vec3 v) {
    const float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z), most = x > y ? x : y;
    return most > z ? most : z;
}

/* Returns the same for a point of a triangle, in the scene of that lift: in proportion to the
 * coordinates that are rounded, its own, its corners' (unless these are NULL) and hardly the
 * scene's, so that a small model on wide ground or under a distant sky casts its shadow.
 * Where a ray meets a triangle is a mean of its corners' distances, which rounds off it by up to
 * about 1.5e-7 of their coordinates. Normals and what is modeled ask for more, but only in
 * proportion to how far the point is from the origin. */
static inline float trace_lift_at(float lift, lmp_vec3 point, const lmp_vec3 corners[3]) {
    const float own = 1e-4f * trace_largest(point);
    float least = own > lift / 100 ? own : lift / 100;
    for (int i = 0; corners && i < 3; i++) {
        const float far = 1e-6f * trace_largest(corners[i]);
        least = far > least ? far : least;
    }
    return least < lift ? least : lift;
}

#endif
