/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/shadows.h"

shadow *render_device_shadow(render_device *device, const environment *surroundings,
                             const shadow_settings *settings, base_error *error) {
    return shadow_create(device->scene, render_device_bvh(device), surroundings, settings, error);
}
