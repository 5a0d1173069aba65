/* SPDX-License-Identifier: MIT */
#include "app/scene/environment.h"

#include "app/scene/vector.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- files ------------------------------------------------------------------------------------ */

/* Scales radiances and checks that they are finite and not above SCENE_COLOR_MAX. Negative values
 * become 0: resampled images ring a little. */
static bool check_radiance(image *pixels, float strength, const char *path, base_error *error) {
    const size_t count = 3 * (size_t)pixels->width * (size_t)pixels->height;
    for (size_t i = 0; i < count; i++) {
        const float value = pixels->rgb[i] * strength;
        if (!(fabsf(value) <= SCENE_COLOR_MAX))
            return base_fail(error, path, "has a pixel (%d, %d) that is not finite, or above 1e19",
                             (int)(i / 3 % (size_t)pixels->width),
                             (int)(i / 3 / (size_t)pixels->width));
        pixels->rgb[i] = value > 0 ? value : 0;
    }
    return true;
}

static bool open_file(const char *path, float strength, image *light, base_error *error) {
    image pixels;
    if (!image_read(path, IMAGE_PIXELS_MAX, &pixels, error))
        return false;
    bool ok = check_radiance(&pixels, strength, path, error);
    const bool cross =
        pixels.width * 3 == pixels.height * 4 || pixels.width * 4 == pixels.height * 3;
    if (ok && cross) {
        ok = environment_unfold(&pixels, light, error);
    } else if (ok && pixels.width == 2 * pixels.height) {
        *light = pixels;
        return true;
    } else if (ok) {
        ok =
            base_fail(error, path,
                      "is %d x %d pixels: no panorama of 2:1, nor a cube map's cross of 4:3 or 3:4",
                      pixels.width, pixels.height);
    }
    image_free(&pixels);
    return ok;
}

/* --- the studio ------------------------------------------------------------------------------- */

/* Whether nothing in the scene lights it well, unless the command line chose that. */
static bool is_dark(const scene *world) {
    return !world->lights_chosen && !environment_lights_suffice(world);
}

/* The irradiance of level ground by the sky, relative to that of its sun: 0.1 where the sky is
 * clear, more in haze. */
#define SKY_PART 0.2f

static float mean_of(lmp_rgb rgb) {
    return (rgb.r + rgb.g + rgb.b) / 3;
}

/* Returns the sum of what the scene's own suns give to a surface that faces each; 0 where other
 * lights shine, or where the command line chose lights. A mesh that glows with radiance L gives a
 * surface at most pi L: it counts if that is more than the sky gives. */
static float sunlight(const scene *world) {
    float suns = 0, glow = 0;
    for (size_t i = 0; i < world->light_count; i++) {
        const lmp_light *light = &world->lights[i].emitter;
        if (scene_light_is_sun(light))
            suns += mean_of(lmp_light_irradiance(light, 1, vec(0, 0, 0), light->direction));
        else if (world->lights[i].hidden && scene_light_extent(light) > 0)
            glow = fmaxf(glow, PI * mean_of(light->radiance));
        else
            return 0;
    }
    return world->lights_chosen || glow > SKY_PART * suns ? 0 : suns;
}

/* Whether little but suns lights a scene that the sky would light, too: the walls of a room seen
 * from inside would keep it out. */
static bool lacks_sky(const scene *world) {
    return sunlight(world) > 0 && environment_suits_shadows(true, world);
}

/* Makes the studio with its front toward the camera that frames the scene by default. */
static bool open_studio(const environment_options *options, float strength, const scene *world,
                        environment *e, base_error *error) {
    const scene_camera camera = scene_default_camera(world, 1);
    const float x = camera.eye[0] - camera.target[0], z = camera.eye[2] - camera.target[2];
    const float suns = sunlight(world);
    if (!environment_make_studio(e, error))
        return false;
    e->azimuth += x * x + z * z > 0 ? (float)atan2((double)z, (double)x) : PI / 2;
    e->studio = true;
    e->exposure = suns > 0 ? 0.0f : 1.0f; /* a sky's strength is that of its sun */
    if (e->exposure > 0 && (!options->name || is_dark(world))) /* no name: it is dark */
        e->faint = world->light_count;
    /* the suns light the paper, too */
    const float shown = strength + suns / STUDIO_IRRADIANCE;
    return check_radiance(&e->light, strength, "studio", error) &&
           check_radiance(&e->backdrop, shown, "studio", error);
}

environment_options environment_choose(const environment_options *options, const scene *world) {
    environment_options chosen = *options;
    if (options->name)
        return chosen;
    chosen.name = "studio";
    if (lacks_sky(world)) {
        const float strength = chosen.strength * SKY_PART * sunlight(world) / STUDIO_IRRADIANCE;
        chosen.strength = fminf(strength, (float)ENVIRONMENT_STRENGTH_MAX);
        base_note(world->name,
                  "little but suns lights it, so the built-in studio shines as their sky "
                  "(--environment none leaves it out)");
    } else if (is_dark(world)) {
        base_note(world->name,
                  "%s, lit by the built-in studio (--environment, --lights and --random-lights "
                  "choose others)",
                  world->light_count > 0 ? "what glows in it lights it too little"
                                         : "no lights in it");
    } else {
        chosen.name = "none";
    }
    return chosen;
}

const char *const environment_ground_names[] = { "auto", "on", "off", NULL };

bool environment_is_file(const char *name) {
    return strcmp(name, "none") != 0 && strcmp(name, "studio") != 0;
}

bool environment_open(const environment_options *options, const scene *world, environment *e,
                      base_error *error) {
    const environment_options chosen = environment_choose(options, world);
    const char *name = chosen.name;
    memset(e, 0, sizeof *e);
    e->azimuth = -options->rotation * PI / 180;
    e->ground = options->ground == ENVIRONMENT_GROUND_ON ||
                (options->ground == ENVIRONMENT_GROUND_SUITS && strcmp(name, "studio") == 0 &&
                 !scene_is_inside(world));
    if (strcmp(name, "none") == 0)
        return true;
    if (!environment_is_file(name)) {
        if (open_studio(options, chosen.strength, world, e, error))
            return true;
    } else if (open_file(name, options->strength, &e->light, error)) {
        e->backdrop = e->light;
        return true;
    }
    environment_free(e);
    return false;
}

void environment_free(environment *e) {
    if (e->backdrop.rgb != e->light.rgb)
        image_free(&e->backdrop);
    image_free(&e->light);
    free(e->sh);
    memset(e, 0, sizeof *e);
}
