/* SPDX-License-Identifier: MIT */
/* lamps.h - rays to the nearest of many lights that are seen, spheres and areas, with the same bits
 * everywhere, as for triangles (trace.h). */
#ifndef LAMPION_SCENE_TRACE_LAMPS_H
#define LAMPION_SCENE_TRACE_LAMPS_H

#include "app/scene/trace/trace.h"

typedef struct trace_lamp {
    const lmp_light *light; /* a sphere or an area */
    uint32_t number;        /* reported by a hit */
} trace_lamp;

typedef struct trace_lamps trace_lamps;

/* Copies the lights; they share Embree's device with a tree of triangles, which must outlive them.
 * Returns NULL if memory ran out. */
trace_lamps *trace_lamps_create(const trace_bvh *bvh, const trace_lamp *lamps, size_t count);
void trace_lamps_destroy(trace_lamps *lamps);

/* Replaces each hit in `hits` by that of the nearest light if that is nearer: its distance, and its
 * number as `instance`. A ray from inside a sphere or a tube sees its far side, and one from behind
 * passes through a one-sided area; of lights at equal distance the first in the array is hit. */
void trace_lamps_nearest_n(const trace_lamps *lamps, const trace_rays *rays,
                           bool found[TRACE_LANES], trace_hit hits[TRACE_LANES]);

#endif
