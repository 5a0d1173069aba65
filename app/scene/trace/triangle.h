/* SPDX-License-Identifier: MIT */
/* triangle.h - rays side by side against one triangle, by our own arithmetic alone: which triangle
 * a ray hits has the same bits on every instruction set. After Woop, Benthin and Wald, Watertight
 * Ray/Triangle Intersection (2013). */
#ifndef LAMPION_SCENE_TRACE_TRIANGLE_H
#define LAMPION_SCENE_TRACE_TRIANGLE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define TRIANGLE_LANES 16

typedef float triangle_lanes[TRIANGLE_LANES];

/* Rays as the test needs them: in a space sheared so that each ray runs along an axis. */
typedef struct triangle_rays {
    int axis[TRIANGLE_LANES]; /* the axis along which the direction is longest */
    int common;               /* the axis of all rays, or -1 if they differ */
    triangle_lanes origin[3]; /* along that axis, the next, and the one after it */
    triangle_lanes shear[3];  /* 1 / the direction along the axis; the others times that */
} triangle_rays;

/* Prepares `count` rays, 1 to TRIANGLE_LANES, from planar origins and directions. A direction of
 * length 0 hits nothing. */
void triangle_rays_set(const float *const origin[3], const float *const direction[3], size_t count,
                       triangle_rays *rays);

typedef struct triangle_hits {
    triangle_lanes distance;    /* in lengths of the direction; NaN for a miss */
    triangle_lanes u, v;        /* weights of the second and third corner */
    bool front[TRIANGLE_LANES]; /* whether the corners run counter-clockwise as seen by the ray */
} triangle_hits;

/* The hit of one ray. */
typedef struct triangle_hit {
    float distance, u, v;
    bool front;
} triangle_hit;

static inline triangle_hit triangle_hit_at(const triangle_hits *hits, size_t i) {
    return (triangle_hit) { hits->distance[i], hits->u[i], hits->v[i], hits->front[i] };
}

/* Tests rays `first` to first + count - 1 against a triangle of three corners; results, and the
 * distances where the rays end, begin at index 0. Returns the rays that hit it up to there, ray i
 * as bit i; the hits of other rays may not be set.
 *
 * Of triangles that share an edge or a corner, at least one is hit: the side on which an edge
 * passes depends on its corners alone, each moved into the ray's space by itself, and is never
 * rounded to the other side. A distance is a mean of the corners' own with weights that are never
 * negative, so that it lies within the triangle's bounds however grazing the ray. */
uint32_t triangle_test(const triangle_rays *rays, size_t first, size_t count,
                       const float *const corners[3], const float *ends, triangle_hits *hits);

#endif
