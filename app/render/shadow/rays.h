/* SPDX-License-Identifier: MIT */
/* rays.h - the noisy planes of a frame: a few rays a pixel to lights that matter there. */
#ifndef LAMPION_SHADOW_RAYS_H
#define LAMPION_SHADOW_RAYS_H

#include "app/render/shadow/batch.h"
#include "app/render/shadow/planes.h"
#include "app/render/shadow/source.h"

typedef struct shadow_job {
    shadow_view view;
    const trace_hit *hits; /* of the image's pixels, or NULL */
    const shadow_source *sources;
    size_t source_count;
    int rays;    /* a pixel */
    int spacing; /* of a row's pixels that send them, where these may speak for those between */
    int sample;  /* of the frame: which ones */
    uint32_t seed;
} shadow_job;

/* Pixels whose rays are in a batch. */
typedef struct shadow_group {
    uint32_t x[SHADOW_LANES], y[SHADOW_LANES];
    int count;
    shadow_lanes footprint;
    shadow_vectors smooth;
    shadow_lanes sums[SHADOW_VALUES]; /* of planes.h */
} shadow_group;

/* What a thread works with. */
typedef struct shadow_work {
    shadow_lanes *weights; /* of all sources */
    render_tile tile;
    shadow_batch batch;
    int group_of[SHADOW_SHOTS];
    shadow_group groups[SHADOW_SHOTS];
} shadow_work;

/* NULL without memory. */
shadow_work *shadow_work_create(const shadow_job *job);
void shadow_work_destroy(shadow_work *work);

/* Fills the planes of a rectangle, which work->tile holds, of at most RENDER_TILE pixels a side.
 * Returns how many rays toward lights were sent. */
size_t shadow_rays_tile(const shadow_job *job, const render_rectangle *pixels, shadow_work *work,
                        shadow_planes *planes);

#endif
