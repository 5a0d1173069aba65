/* SPDX-License-Identifier: MIT */
/* transfer_direct.h - the light that surfels receive from lights and the environment. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_DIRECT_H
#define LAMPION_RENDER_SHADOW_TRANSFER_DIRECT_H

#include "app/render/shadow/transfer_lists.h"
#include "app/render/surfaces.h"

/* Computes the direct irradiance of every surfel in a frame's light, on all cores: with shadows,
 * whose rays are spread over each light, or without. Returns false if memory ran out. */
bool transfer_light_directly(const transfer_view *view, const render_frame *frame,
                             const environment *around, bool shadows, lmp_rgb *direct);

#endif
