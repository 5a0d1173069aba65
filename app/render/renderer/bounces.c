/* SPDX-License-Identifier: MIT */
#include "app/render/renderer/bounces.h"

#include <stdlib.h>

transfer *render_device_transfer(render_device *device, const override_set *replaced,
                                 const transfer_settings *settings, base_error *error) {
    lmp_rgb *albedos = NULL;
    if (replaced->count > 0 && !(albedos = override_albedos(replaced, device->scene))) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    transfer *made =
        transfer_create(device->scene, albedos, render_device_bvh(device), settings, error);
    free(albedos);
    return made;
}
