/* SPDX-License-Identifier: MIT */
/* bounces.h - the bounced light of what a device draws. */
#ifndef LAMPION_RENDER_RENDERER_BOUNCES_H
#define LAMPION_RENDER_RENDERER_BOUNCES_H

#include "app/base/cli.h"
#include "app/render/renderer/override.h"
#include "app/render/shadow/transfer.h"

#define BOUNCES_OPTION_ROW(variable)                                                               \
    {                                                                                              \
        .name = "bounces", .kind = CLI_INT, .target = &(variable), .argument = "N",                \
        .help = "how often surfaces reflect light on to other surfaces, as diffuse ones do; 0 "    \
                "means direct light alone",                                                        \
        .minimum = 0, .maximum = TRANSFER_BOUNCES_MAX                                              \
    }

/* Creates the bounced light of the device's scene, by the rays of render_device_bvh, as
 * transfer_create does: the device and the environment must outlive it. Surfaces reflect as the
 * materials that replace theirs do. */
transfer *render_device_transfer(render_device *device, const override_set *replaced,
                                 const transfer_settings *settings, base_error *error);

#endif
