/* SPDX-License-Identifier: MIT */
/* batch.h - rays of many neighboring pixels, sent light by light: those from neighbors to one light
 * go nearly the same way, and are traced together. */
#ifndef LAMPION_SHADOW_BATCH_H
#define LAMPION_SHADOW_BATCH_H

#include "app/render/shadow/point.h"

/* One ray a lane, and what it stands for. */
typedef struct shadow_shot {
    trace_rays rays;
    int source[SHADOW_LANES];
    shadow_lanes distance;   /* at which it is hidden, once it is sent; INFINITY */
    shadow_lanes size, mean; /* of the light, as in shadow_samples; of the value's colors */
    shadow_vectors value;
} shadow_shot;

enum { SHADOW_SHOTS = 32, SHADOW_SHOT_RAYS = SHADOW_SHOTS * SHADOW_LANES };

typedef struct shadow_batch {
    int around; /* the source that is on all sides, to which rays part; -1: none */
    int count;
    shadow_shot shots[SHADOW_SHOTS];
    uint32_t order[2][SHADOW_SHOT_RAYS]; /* rays, by the sources that they go to */
} shadow_batch;

/* Sends the rays that have a length, and sets the distances of all; returns how many were sent. */
size_t shadow_batch_send(shadow_batch *batch, const trace_bvh *bvh);

#endif
