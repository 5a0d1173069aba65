/* SPDX-License-Identifier: MIT */
/* transfer_receivers.h - points of a scene's surfaces at which bounced light is read. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_RECEIVERS_H
#define LAMPION_RENDER_SHADOW_TRANSFER_RECEIVERS_H

#include "app/render/shadow/transfer_lists.h"

/* Makes a scene's receivers. They are nearer to each other than the surfels: their light is found
 * once, after the last bounce, and nothing is lit by them, so they cost little and show details of
 * the light that surfels are too far apart for. Their spacing is a part of the surfels', the least
 * where surfaces are near each other; that of the result is the largest. Their albedo is 0. Returns
 * false if memory ran out; free receivers->at in any case. */
#define TRANSFER_PART       0.5f
#define TRANSFER_PART_LEAST 0.25f
bool transfer_receivers_make(const scene *world, const trace_bvh *bvh,
                             const transfer_surfels *surfels, transfer_surfels *receivers);

#endif
