/* SPDX-License-Identifier: MIT */
/* transfer_lists.h - what rays between surfels find, once. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_LISTS_H
#define LAMPION_RENDER_SHADOW_TRANSFER_LISTS_H

#include "app/render/shadow/transfer_cells.h"
#include "app/scene/trace/trace.h"

/* Removes the surfels of surfaces that another one covers closely, such as a floor's under a rug,
 * and of those inside of things, which see mostly backs: they are dark, and points beside them
 * would find them nearest. */
void transfer_drop_buried(const scene *world, const trace_bvh *bvh, transfer_surfels *surfels);

/* Whether a surfel, number `index` of its own, is covered closely, by less than `least`, or sees
 * mostly the backs of surfaces. */
bool transfer_is_buried(const scene *world, const trace_bvh *bvh, const lmp_transfer_surfel *surfel,
                        size_t index, float least);

/* Returns the harmonic mean of the distances that a few rays from a surfel go: what lights it, and
 * so how its light changes along its surface, is about so far away. INFINITY: none meets a thing.
 */
float transfer_distance(const scene *world, const trace_bvh *bvh, const lmp_transfer_surfel *surfel,
                        size_t index);

/* What the rays of a scene are cast by. */
typedef struct transfer_view {
    const scene *scene;
    const trace_bvh *bvh;
    const transfer_cells *cells;
} transfer_view;

/* The hits and links of lmp_transfer_desc. */
enum { TRANSFER_LINKS = 24 };
typedef struct transfer_lists {
    uint32_t *hits, *links;
} transfer_lists;

/* What rays are cast for. */
typedef struct transfer_task {
    const transfer_view *from; /* surfels or receivers, which are linked to each other */
    const transfer_view *to;   /* surfels, which rays hit */
    size_t rays;               /* from each */
    size_t first;              /* the number among hits of the first surfel */
    double begin, end;         /* of the progress */
} transfer_task;

/* Casts all rays, on all cores, and tells the host's progress. Returns false if memory ran out;
 * free the lists in any case. */
bool transfer_lists_create(const transfer_task *task, const lmp_host *host, transfer_lists *lists);
void transfer_lists_free(transfer_lists *lists);

/* Returns the nearest surfel that is seen from a point of a surface, one of about the same normal
 * if there is any; LMP_TRANSFER_NONE if there is none. */
uint32_t transfer_nearest(const transfer_view *view, lmp_vec3 point, lmp_vec3 normal);

/* Returns the surfel where a ray ends; LMP_TRANSFER_NONE where it meets nothing, or the back of a
 * single-sided surface. */
uint32_t transfer_source(const transfer_view *view, lmp_vec3 from, lmp_vec3 direction);

#endif
