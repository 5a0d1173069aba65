/* SPDX-License-Identifier: MIT */
/* rays.h - the noisy planes of a frame: a few rays per pixel to the lights that matter there. */
#ifndef LAMPION_RENDER_SHADOW_RAYS_H
#define LAMPION_RENDER_SHADOW_RAYS_H

#include "app/render/shadow/batch.h"
#include "app/render/shadow/planes.h"
#include "app/render/shadow/source.h"

typedef struct shadow_job {
    shadow_view view;
    const shadow_source *sources;
    size_t source_count;
    int rays;    /* per pixel */
    int spacing; /* distance of a row's pixels that send rays, where neighbors are alike */
    int sample;  /* of the frame: selects the pixels that send rays */
    uint32_t seed;
} shadow_job;

/* Returns how many sets of values the planes of a job have. */
int shadow_job_sets(const shadow_job *job);

/* A group of pixels whose rays are in a batch. */
typedef struct shadow_group {
    uint32_t x[SHADOW_LANES], y[SHADOW_LANES];
    int count;
    shadow_lanes footprint;
    shadow_vectors smooth;
    shadow_lanes sums[SHADOW_SETS][SHADOW_VALUES]; /* as in planes.h */
} shadow_group;

/* The buffers of a thread. */
typedef struct shadow_work {
    shadow_lanes *weights; /* cumulative, of all sources */
    render_tile tile;
    shadow_batch batch;
    int group_of[SHADOW_SHOTS];
    shadow_group groups[SHADOW_SHOTS];
    size_t sent;    /* rays toward lights */
    double seconds; /* spent on these rays */
} shadow_work;

/* Creates a thread's buffers; returns NULL if memory ran out. */
shadow_work *shadow_work_create(const shadow_job *job);
void shadow_work_destroy(shadow_work *work);

/* Fills the planes of a rectangle of at most RENDER_TILE pixels a side, which work->tile holds;
 * `surfaces` are those of the tile, perhaps with hits. */
void shadow_rays_tile(const shadow_job *job, const render_surfaces *surfaces,
                      const render_rectangle *pixels, shadow_work *work, shadow_planes *planes);

#endif
