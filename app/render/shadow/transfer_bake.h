/* SPDX-License-Identifier: MIT */
/* transfer_bake.h - all of a scene's bounces that does not depend on lights, made once. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_BAKE_H
#define LAMPION_RENDER_SHADOW_TRANSFER_BAKE_H

#include "app/render/shadow/transfer_lists.h"

/* Points of a scene's surfaces, and what their rays have found. Light bounces between the surfels;
 * from them the receivers have it, which are the surfels of a transfer of their own, and the
 * surfels its sky. */
typedef struct transfer_layer {
    transfer_surfels points;
    transfer_cells cells;
    lmp_transfer *transfer; /* NULL in a scene without surfaces */
} transfer_layer;

enum { TRANSFER_SURFELS, TRANSFER_RECEIVERS, TRANSFER_LAYERS };
typedef struct transfer_baked {
    transfer_layer layers[TRANSFER_LAYERS];
} transfer_baked;

/* Makes a scene's points and casts their rays, with a progress bar, or reads them from the cache,
 * where they are kept by the scene's geometry and materials; `albedos` as for
 * transfer_surfels_make. Returns NULL if memory ran out. */
transfer_baked *transfer_bake(const scene *world, const lmp_rgb *albedos, const trace_bvh *bvh);
void transfer_baked_destroy(transfer_baked *baked);

#endif
