/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/bounces.h"

transfer *render_device_transfer(render_device *device, const transfer_settings *settings,
                                 base_error *error) {
    return transfer_create(device->scene, render_device_bvh(device), settings, error);
}
