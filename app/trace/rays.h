/* SPDX-License-Identifier: MIT */
/* rays.h - what rays are, and what they hit. */
#ifndef LAMPION_TRACE_RAYS_H
#define LAMPION_TRACE_RAYS_H

#include "app/scene/scene.h"

#include <math.h>

typedef struct trace_bvh trace_bvh;

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
    bool together;               /* of TRACE_LIGHT: they go nearly the same way */
} trace_rays;

#define TRACE_NOTHING UINT32_MAX
typedef struct trace_hit {
    float distance;    /* in lengths of the direction; INFINITY of nothing */
    uint32_t instance; /* or TRACE_NOTHING: the rest is not set */
    uint32_t triangle; /* of the instance */
    float u, v;        /* weights of its second and third corner */
} trace_hit;

static inline trace_hit trace_miss(void) {
    return (trace_hit) { .distance = INFINITY, .instance = TRACE_NOTHING };
}

/* How far a ray that leaves a surface starts off it, against rounding. */
double trace_lift(const scene *scene);

#endif
