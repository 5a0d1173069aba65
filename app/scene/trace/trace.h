/* SPDX-License-Identifier: MIT */
/* trace.h - rays through the triangles of a scene; what an alpha mask cuts out stops no ray.
 *
 * Embree finds the triangles that may be hit, and our own arithmetic decides which are: hits have
 * the same bits on every instruction set, alone and side by side, and among equally near triangles
 * the first of the first instance is hit. The environment variable LAMPION_EMBREE is Embree's
 * configuration, for tests: "isa=sse2". */
#ifndef LAMPION_SCENE_TRACE_TRACE_H
#define LAMPION_SCENE_TRACE_TRACE_H

#include "app/scene/trace/rays.h"

/* Builds the trees of a scene, which must outlive them; returns NULL if memory ran out. */
trace_bvh *trace_create(const scene *scene);
void trace_destroy(trace_bvh *bvh);

/* Writes "Embree" and the loaded version, as a tree's device reports it, or a new device if bvh is
 * NULL. */
void trace_version(const trace_bvh *bvh, char *text, size_t size);

/* Finds the three corners of the hit triangle, in the world, and their weights. */
void trace_corners(const scene *scene, const trace_hit *hit, scene_vertex corners[3],
                   double weights[3]);

/* Returns the alpha at a hit. */
double trace_alpha(const scene *scene, const trace_hit *hit);

/* Finds the nearest triangle along a ray; may be called from any thread. */
trace_hit trace_nearest(const trace_bvh *bvh, trace_kind kind, const float origin[3],
                        const float direction[3]);

/* Finds the nearest triangles along rays side by side, up to their lengths. */
void trace_nearest_n(const trace_bvh *bvh, trace_kind kind, const trace_rays *rays,
                     trace_hit hits[TRACE_LANES]);

/* Whether a triangle stops a ray of light within `length` >= 0, in lengths of the direction. The
 * answer is that of the nearest hit, but the first hit found gives it. */
bool trace_occluded(const trace_bvh *bvh, const float origin[3], const float direction[3],
                    float length);

/* Whether triangles stop rays of light side by side; false in lanes that hold none. */
void trace_occluded_n(const trace_bvh *bvh, const trace_rays *rays, bool occluded[TRACE_LANES]);

#endif
