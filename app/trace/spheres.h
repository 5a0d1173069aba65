/* SPDX-License-Identifier: MIT */
/* spheres.h - rays to the nearest of many spheres, with the same bits everywhere, as those through
 * triangles (trace.h). */
#ifndef LAMPION_TRACE_SPHERES_H
#define LAMPION_TRACE_SPHERES_H

#include "app/trace/trace.h"

typedef struct trace_sphere {
    float center[3], radius;
    uint32_t number; /* what a hit says */
} trace_sphere;

typedef struct trace_spheres trace_spheres;

/* Copies them; they share Embree's device with a tree of triangles, which must outlive them. NULL
 * without memory. */
trace_spheres *trace_spheres_create(const trace_bvh *bvh, const trace_sphere *spheres,
                                    size_t count);
void trace_spheres_destroy(trace_spheres *spheres);

/* Where a sphere is before what `hits` holds, the hit becomes that of the nearest: its distance,
 * and its number as `instance`. A ray from inside a sphere sees its far side; of spheres at one
 * distance the first of the array counts. */
void trace_spheres_nearest_n(const trace_spheres *spheres, const trace_rays *rays,
                             bool found[TRACE_LANES], trace_hit hits[TRACE_LANES]);

#endif
