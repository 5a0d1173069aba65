/* SPDX-License-Identifier: MIT */
/* trace.h - rays through the triangles of a scene. What an alpha mask cuts out stops none of them.
 *
 * Embree finds the triangles that may be hit, and our own arithmetic which of them are: hits have
 * the same bits on every instruction set, alone and side by side, and of triangles at one distance
 * the first instance's first counts. The environment variable LAMPION_EMBREE is Embree's
 * configuration, for tests: "isa=sse2". */
#ifndef LAMPION_TRACE_H
#define LAMPION_TRACE_H

#include "app/trace/rays.h"

/* NULL without memory. The scene must outlive it. */
trace_bvh *trace_create(const scene *scene);
void trace_destroy(trace_bvh *bvh);

/* "Embree" and the version that is loaded, which a tree's device tells; without one, a new device.
 */
void trace_version(const trace_bvh *bvh, char *text, size_t size);

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
