/* SPDX-License-Identifier: MIT */
#include "app/truth/reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Few pixels, but without much noise, because noise lowers an average of logarithms. */
enum { METER_PIXELS = 96 * 54, METER_SAMPLES = 64 };

bool reference_meter(const scene *world, const reference_settings *settings, image *pixels,
                     base_error *error) {
    const double all = (double)settings->width * settings->height,
                 scale = all > METER_PIXELS ? sqrt(METER_PIXELS / all) : 1;
    reference_settings small = *settings;
    environment around = settings->environment ? *settings->environment : (environment) { 0 };
    scene dark = *world;
    scene_material *materials = malloc((world->material_count + 1) * sizeof *materials);
    scene_light *lights = malloc((world->light_count + 1) * sizeof *lights);
    image unused;
    bool ok = (materials && lights) || base_fail(error, NULL, "out of memory");
    for (size_t i = 0; ok && i < world->material_count; i++) {
        materials[i] = world->materials[i];
        memset(materials[i].emission, 0, sizeof materials[i].emission);
    }
    for (size_t i = 0; ok && i < world->light_count; i++) {
        lights[i] = world->lights[i];
        lights[i].hidden = 1;
        lights[i].glow = 0; /* its mesh does not glow here, so it shines for itself */
    }
    dark.materials = materials;
    dark.lights = lights;
    memset(&around.backdrop, 0, sizeof around.backdrop);
    small.environment = settings->environment ? &around : NULL;
    small.width = (int)fmax(1, settings->width * scale);
    small.height = (int)fmax(1, settings->height * scale);
    small.samples = METER_SAMPLES;
    small.shard[0] = small.shard[1] = 0;
    small.error = 0;
    small.metering = true;
    ok = ok && reference_render(&dark, &small, pixels, &unused, error);
    if (ok)
        image_free(&unused);
    free(materials);
    free(lights);
    return ok;
}
