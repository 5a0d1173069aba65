/* SPDX-License-Identifier: MIT */
/* transfer_direct.h - the light that surfels receive from lights and the environment. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_DIRECT_H
#define LAMPION_RENDER_SHADOW_TRANSFER_DIRECT_H

#include "app/render/shadow/transfer_lists.h"
#include "app/render/surfaces.h"

/* How surfels are lit. */
typedef struct transfer_way {
    const environment *around; /* NULL: none */
    bool shadows;              /* whether surfaces hide lights, by rays spread over each light */
    bool quick;                /* whether rays are few */
} transfer_way;

/* Computes the direct irradiance of every surfel in a frame's light, on all cores. Returns false if
 * memory ran out. */
bool transfer_light_directly(const transfer_view *view, const render_frame *frame,
                             const transfer_way *way, lmp_rgb *direct);

#endif
