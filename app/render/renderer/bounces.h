/* SPDX-License-Identifier: MIT */
/* bounces.h - the bounced light of what a device draws. */
#ifndef LAMPION_RENDER_RENDERER_BOUNCES_H
#define LAMPION_RENDER_RENDERER_BOUNCES_H

#include "app/render/renderer/renderer.h"
#include "app/render/shadow/transfer.h"

/* Creates the bounced light of the device's scene, by the rays of render_device_bvh, as
 * transfer_create does: the device and the environment must outlive it. */
transfer *render_device_transfer(render_device *device, const transfer_settings *settings,
                                 base_error *error);

#endif
