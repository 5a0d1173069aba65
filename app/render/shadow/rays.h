/* SPDX-License-Identifier: MIT */
/* rays.h - the noisy planes of a frame: a few rays a pixel to lights that matter there. */
#ifndef LAMPION_SHADOW_RAYS_H
#define LAMPION_SHADOW_RAYS_H

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

/* Fills row y of the planes; `weights` is memory for as many as there are sources. Returns how many
 * rays toward lights were sent. */
size_t shadow_rays_row(const shadow_job *job, const render_tile *row, int y, shadow_lanes *weights,
                       shadow_planes *planes);

#endif
