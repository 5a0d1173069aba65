/* SPDX-License-Identifier: MIT */
/* transfer_read.h - the bounced light of an image's surfaces. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_READ_H
#define LAMPION_RENDER_SHADOW_TRANSFER_READ_H

#include "app/render/shadow/transfer_lists.h"
#include "app/render/surfaces.h"

/* Fills a rectangle's planes of bounced light as render_bounces says: every material reflects the
 * irradiance of the surfels near it as if it came evenly from all sides. */
void transfer_read(const transfer_view *view, const lmp_transfer *transfer,
                   const render_surfaces *surfaces, const render_rectangle *pixels,
                   render_tile *tile);

#endif
