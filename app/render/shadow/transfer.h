/* SPDX-License-Identifier: MIT */
/* transfer.h - light that bounces, by the library's transfer: the scene's surfels and rays are made
 * once, and every surface reads the surfels near it (docs/transfer.md). Named after the library's
 * part that it fills. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_H
#define LAMPION_RENDER_SHADOW_TRANSFER_H

#include "app/render/surfaces.h"
#include "app/scene/trace/trace.h"

typedef struct transfer transfer;

/* How light bounces. */
typedef struct transfer_settings {
    int bounces;               /* 0 … TRANSFER_BOUNCES_MAX */
    bool shadows;              /* whether surfaces hide lights from surfels */
    bool quick;                /* whether surfels send few rays to lights, for lights that move */
    const environment *around; /* NULL: none; must outlive the transfer */
} transfer_settings;
#define TRANSFER_BOUNCES_MAX 1000

/* Makes a scene's surfels and casts their rays; the scene and its tree must outlive the result.
 * `albedos` may be NULL; it has a color per material of the scene, which replaces what the material
 * reflects, or is below 0. Returns NULL on failure. */
transfer *transfer_create(const scene *world, const lmp_rgb *albedos, const trace_bvh *bvh,
                          const transfer_settings *settings, base_error *error);
void transfer_destroy(transfer *transfer);

/* Changes the settings. */
void transfer_set(transfer *transfer, const transfer_settings *settings);

/* Forgets the light of the surfels, because the environment has changed. */
void transfer_relight(transfer *transfer);

/* Returns what a frame needs to be drawn with bounced light; zero in a scene without surfaces. */
render_bounces transfer_bounces(transfer *transfer);

/* Returns the radiance of the surface that is seen from a point in a direction, in the light of the
 * last frame: what it reflects of the lights and, by so many bounces, of other surfaces. It is 0
 * where there is none, or its back. */
lmp_rgb transfer_radiance(const transfer *transfer, lmp_vec3 point, lmp_vec3 direction);

typedef struct transfer_statistics {
    size_t surfels, receivers, bytes; /* of the library's transfers */
    float spacing;                    /* of the surfels */
    double create_milliseconds;       /* surfels and their rays, once */
    double light_milliseconds;        /* direct light of surfels, where lights have moved */
    double bounce_milliseconds;       /* all bounces */
} transfer_statistics;
transfer_statistics transfer_describe(const transfer *transfer);

#endif
