/* SPDX-License-Identifier: MIT */
/* triangle.h - rays side by side against one triangle, by our own arithmetic alone: which triangle
 * a ray hits has the same bits on every instruction set. After Woop, Benthin and Wald, Watertight
 * Ray/Triangle Intersection (2013). */
#ifndef LAMPION_TRACE_TRIANGLE_H
#define LAMPION_TRACE_TRIANGLE_H

#include <stdbool.h>
#include <stddef.h>

#define TRIANGLE_LANES 16

typedef float triangle_lanes[TRIANGLE_LANES];

/* Rays as the test needs them: in the space that is sheared so that the ray runs along an axis. */
typedef struct triangle_rays {
    int axis[TRIANGLE_LANES]; /* along which the direction is longest */
    int common;               /* the axis of all rays, or -1 */
    triangle_lanes origin[3]; /* from that axis on: the axis, the next, and the one after it */
    triangle_lanes shear[3];  /* 1 / the direction along the axis, and what the others come to */
} triangle_rays;

/* Makes `count` rays, 1 to TRIANGLE_LANES, of rows of origins and directions. A direction of no
 * length hits nothing. */
void triangle_rays_set(const float *const origin[3], const float *const direction[3], size_t count,
                       triangle_rays *rays);

typedef struct triangle_hits {
    triangle_lanes distance;    /* in lengths of the direction; NaN of rays that pass by */
    triangle_lanes u, v;        /* weights of the second and third corner */
    bool front[TRIANGLE_LANES]; /* the corners run counter-clockwise as the ray sees them */
} triangle_hits;

/* Of one of them. */
typedef struct triangle_hit {
    float distance, u, v;
    bool front;
} triangle_hit;

static inline triangle_hit triangle_hit_at(const triangle_hits *hits, size_t i) {
    return (triangle_hit) { hits->distance[i], hits->u[i], hits->v[i], hits->front[i] };
}

/* Tests rays `first` to first + count - 1 against the triangle of three corners; results stand from
 * 0 on. False if all pass by: then *hits is not set.
 *
 * Of triangles that share an edge or a corner one at least is hit: the side on which an edge passes
 * comes from its corners alone, each moved into the ray's space by itself, and is never rounded to
 * the other side. A distance is a mean of the corners' own, weighted by what is never negative, so
 * that it lies within the triangle's bounds however grazing the ray. */
bool triangle_test(const triangle_rays *rays, size_t first, size_t count,
                   const float *const corners[3], triangle_hits *hits);

#endif
