/* SPDX-License-Identifier: MIT */
/* transfer_read.h - the bounced light of an image's surfaces. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_READ_H
#define LAMPION_RENDER_SHADOW_TRANSFER_READ_H

#include "app/render/shadow/transfer_bake.h"
#include "app/render/surfaces.h"

/* Fills a rectangle's planes of bounced light as render_bounces says: every material reflects the
 * irradiance of the receivers near it as if it came evenly from all sides. `views` has one for each
 * layer. */
void transfer_read(const transfer_baked *baked, const transfer_view *views,
                   const render_surfaces *surfaces, const render_rectangle *pixels,
                   render_tile *tile);

#endif
