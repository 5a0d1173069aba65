/* SPDX-License-Identifier: MIT */
/* trace.h - rays through the triangles of a scene. What an alpha mask cuts out stops none of them.
 *
 * Embree finds the triangles that may be hit, and our own arithmetic which of them are: hits have
 * the same bits on every instruction set, alone and side by side, and of triangles at one distance
 * the first instance's first counts. The environment variable LAMPION_EMBREE is Embree's
 * configuration, for tests: "isa=sse2". */
#ifndef LAMPION_TRACE_H
#define LAMPION_TRACE_H

#include "app/scene/scene.h"

typedef struct trace_bvh trace_bvh;

/* NULL without memory. The scene must outlive it. */
trace_bvh *trace_create(const scene *scene);
void trace_destroy(trace_bvh *bvh);

/* "Embree" and the version that is loaded. */
const char *trace_version(void);

/* How far a ray that leaves a surface starts off it, against rounding. */
double trace_lift(const scene *scene);

/* Which triangles stop a ray. */
typedef enum trace_kind {
    TRACE_CAMERA, /* those seen from a side that is drawn */
    TRACE_IMAGE,  /* those, but of what blends by alpha only as many samples as its alpha tells */
    TRACE_LIGHT   /* all */
} trace_kind;

/* Rays side by side; those of length < 0 are none. */
#define TRACE_LANES 16
typedef struct trace_rays {
    float origin[3][TRACE_LANES], direction[3][TRACE_LANES];
    float start[TRACE_LANES], length[TRACE_LANES]; /* in lengths of the direction */
    uint32_t pixel[TRACE_LANES]; /* of TRACE_IMAGE: a number of its own for each */
    uint32_t sample, samples;    /* of TRACE_IMAGE: which of how many it is */
} trace_rays;

#define TRACE_NOTHING UINT32_MAX
typedef struct trace_hit {
    float distance;    /* in lengths of the direction; INFINITY of nothing */
    uint32_t instance; /* or TRACE_NOTHING: the rest is not set */
    uint32_t triangle; /* of the instance */
    float u, v;        /* weights of its second and third corner */
} trace_hit;

/* The three corners of the hit triangle, in world space, and their weights. */
void trace_corners(const scene *scene, const trace_hit *hit, scene_vertex corners[3],
                   double weights[3]);

/* The nearest triangle along a ray, from any thread. */
trace_hit trace_nearest(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                        const float direction[3]);

/* The same of rays beside each other, up to their lengths. */
void trace_nearest_n(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_hit hits[TRACE_LANES]);

#endif
