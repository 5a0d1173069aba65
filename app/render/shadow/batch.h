/* SPDX-License-Identifier: MIT */
/* batch.h - rays of many neighboring pixels, sent light by light: rays from neighbors to one light
 * have nearly the same direction and are traced together. */
#ifndef LAMPION_RENDER_SHADOW_BATCH_H
#define LAMPION_RENDER_SHADOW_BATCH_H

#include "app/render/shadow/point.h"

/* One ray per lane, and its contribution. */
typedef struct shadow_shot {
    trace_rays rays;
    int source[SHADOW_LANES];
    shadow_lanes distance;   /* at which the sent ray is blocked; INFINITY: nowhere */
    shadow_lanes size, mean; /* of the light, as in shadow_samples; mean of the value's channels */
    shadow_vectors value;
} shadow_shot;

/* Enough for two rays of each pixel of a tile: the more rays are sorted, the fuller are the packets
 * that each light gets. */
enum {
    SHADOW_SHOTS = 2 * RENDER_TILE_PIXELS / SHADOW_LANES,
    SHADOW_SHOT_RAYS = SHADOW_SHOTS * SHADOW_LANES
};

typedef struct shadow_batch {
    int around; /* the number of the environment's source, to which rays diverge; -1: none */
    int count;
    shadow_shot shots[SHADOW_SHOTS];
    uint32_t order[2][SHADOW_SHOT_RAYS]; /* rays, sorted by their sources */
} shadow_batch;

/* Sends the rays whose length is not negative, and sets the distances of all; returns how many were
 * sent. */
size_t shadow_batch_send(shadow_batch *batch, const trace_bvh *bvh);

#endif
