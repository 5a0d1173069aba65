/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer.h"

#include "app/base/parallel.h"
#include "app/base/timing.h"
#include "app/render/shadow/transfer_bake.h"
#include "app/render/shadow/transfer_direct.h"
#include "app/render/shadow/transfer_read.h"
#include "app/scene/vector.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct transfer {
    transfer_settings settings;
    transfer_baked *baked;
    transfer_view views[TRANSFER_LAYERS];
    lmp_rgb *direct, *radiance;       /* of the surfels: received from lights; leaving them */
    scene_light *lights, *new_lights; /* by which surfels are lit; of the frame that begins */
    size_t light_count;
    bool lit;
    transfer_statistics statistics;
};

/* --- creation --------------------------------------------------------------------------------- */

static bool create_parts(transfer *t, const scene *world, const lmp_rgb *albedos,
                         const trace_bvh *bvh) {
    t->baked = transfer_bake(world, albedos, bvh);
    if (!t->baked)
        return false;
    for (int i = 0; i < TRANSFER_LAYERS; i++)
        t->views[i] = (transfer_view) { world, bvh, &t->baked->layers[i].cells };
    const size_t surfels = t->baked->layers[TRANSFER_SURFELS].points.count;
    t->direct = malloc((surfels + 1) * sizeof *t->direct);
    t->radiance = malloc((surfels + 1) * sizeof *t->radiance);
    t->lights = malloc(SCENE_LIGHTS_MAX * sizeof *t->lights);
    t->new_lights = malloc(SCENE_LIGHTS_MAX * sizeof *t->new_lights);
    return t->direct && t->radiance && t->lights && t->new_lights;
}

transfer *transfer_create(const scene *world, const lmp_rgb *albedos, const trace_bvh *bvh,
                          const transfer_settings *settings, base_error *error) {
    const double start = timing_now();
    transfer *t = calloc(1, sizeof *t);
    if (t && bvh && create_parts(t, world, albedos, bvh)) {
        const transfer_layer *layers = t->baked->layers;
        t->settings = *settings;
        t->statistics.surfels = layers[TRANSFER_SURFELS].points.count;
        t->statistics.receivers = layers[TRANSFER_RECEIVERS].points.count;
        t->statistics.spacing = layers[TRANSFER_SURFELS].points.spacing;
        for (int i = 0; i < TRANSFER_LAYERS; i++)
            if (layers[i].transfer)
                t->statistics.bytes += lmp_transfer_describe(layers[i].transfer).bytes;
        t->statistics.create_milliseconds = 1e3 * (timing_now() - start);
        return t;
    }
    transfer_destroy(t);
    base_fail(error, world->name, "out of memory for bounces (without --bounces it needs less)");
    return NULL;
}

void transfer_destroy(transfer *t) {
    if (!t)
        return;
    transfer_baked_destroy(t->baked);
    free(t->direct);
    free(t->radiance);
    free(t->lights);
    free(t->new_lights);
    free(t);
}

void transfer_relight(transfer *t) {
    t->lit = false;
}

void transfer_set(transfer *t, const transfer_settings *settings) {
    const transfer_settings *now = &t->settings;
    if (now->bounces != settings->bounces || now->shadows != settings->shadows ||
        now->quick != settings->quick || now->around != settings->around)
        transfer_relight(t);
    t->settings = *settings;
}

transfer_statistics transfer_describe(const transfer *t) {
    return t->statistics;
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* Copies a frame's lights to `lights`, all of them hidden: surfels do not care. */
static void copy_lights(const render_frame *frame, scene_light *lights) {
    memcpy(lights, frame->lights, frame->light_count * sizeof *lights);
    for (size_t i = 0; i < frame->light_count; i++)
        lights[i].hidden = 1;
}

/* Returns the radiance that a surfel reflects, given what it receives from others. */
static lmp_rgb reflected_by(const transfer *t, size_t surfel, lmp_rgb indirect) {
    const lmp_rgb albedo = t->baked->layers[TRANSFER_SURFELS].points.at[surfel].albedo;
    const lmp_rgb direct = t->direct[surfel];
    const float per_pi = (float)M_1_PI;
    return (lmp_rgb) { per_pi * albedo.r * (direct.r + indirect.r),
                       per_pi * albedo.g * (direct.g + indirect.g),
                       per_pi * albedo.b * (direct.b + indirect.b) };
}

/* Finds the radiance that surfels reflect. */
static void find_radiance(const transfer *t) {
    const transfer_layer *surfels = &t->baked->layers[TRANSFER_SURFELS];
    const size_t count = surfels->points.count;
    lmp_transfer_copy_irradiance_n(surfels->transfer, 0, count, lmp_rgb_array_of(t->radiance));
    for (size_t i = 0; i < count; i++)
        t->radiance[i] = reflected_by(t, i, t->radiance[i]);
}

/* Lets light bounce so often between a layer's points. */
static bool iterate(const transfer *t, int layer, int iterations,
                    const lmp_transfer_lighting *lighting) {
    const lmp_transfer_settings settings = { .iterations = iterations };
    const lmp_host host = parallel_host();
    lmp_transfer *iterated = t->baked->layers[layer].transfer;
    return iterations == 0 || !iterated ||
           lmp_transfer_update(&host, iterated, &settings, lighting) == LMP_OK;
}

/* Lets the light of surfels bounce, from darkness, so that a frame does not depend on those before
 * it. Receivers take part in the last bounce alone. */
static bool bounce(const transfer *t) {
    const lmp_transfer_lighting by_lights = { .direct = t->direct },
                                by_surfels = { .sky = t->radiance };
    for (int i = 0; i < TRANSFER_LAYERS; i++)
        if (t->baked->layers[i].transfer)
            lmp_transfer_reset(t->baked->layers[i].transfer);
    if (t->settings.bounces == 0)
        return true;
    if (!iterate(t, TRANSFER_SURFELS, t->settings.bounces - 1, &by_lights))
        return false;
    find_radiance(t);
    return iterate(t, TRANSFER_RECEIVERS, 1, &by_surfels) &&
           iterate(t, TRANSFER_SURFELS, 1, &by_lights);
}

static bool follow_lights(transfer *t, const render_frame *frame) {
    const double start = timing_now();
    const transfer_way way = { t->settings.around, t->settings.shadows, t->settings.quick };
    if (!transfer_light_directly(&t->views[TRANSFER_SURFELS], frame, &way, t->direct))
        return false;
    const double lit = timing_now();
    if (!bounce(t))
        return false;
    t->statistics.light_milliseconds = 1e3 * (lit - start);
    t->statistics.bounce_milliseconds = 1e3 * (timing_now() - lit);
    return true;
}

static bool begin(void *user, const render_frame *frame, base_error *error) {
    transfer *t = user;
    const size_t bytes = frame->light_count * sizeof *t->lights;
    copy_lights(frame, t->new_lights);
    if (t->lit && t->light_count == frame->light_count &&
        memcmp(t->lights, t->new_lights, bytes) == 0)
        return true;
    t->lit = follow_lights(t, frame);
    memcpy(t->lights, t->new_lights, bytes);
    t->light_count = frame->light_count;
    return t->lit || base_fail(error, NULL, "out of memory");
}

static void fill(const void *user, const render_surfaces *surfaces, const render_rectangle *pixels,
                 render_tile *tile) {
    const transfer *t = user;
    transfer_read(t->baked, t->views, surfaces, pixels, tile);
}

render_bounces transfer_bounces(transfer *t) {
    return t->baked->layers[TRANSFER_SURFELS].transfer
               ? (render_bounces) { .begin = begin, .fill = fill, .user = t }
               : (render_bounces) { .user = NULL };
}

/* --- from a point ----------------------------------------------------------------------------- */

lmp_rgb transfer_radiance(const transfer *t, lmp_vec3 point, lmp_vec3 direction) {
    const transfer_layer *surfels = &t->baked->layers[TRANSFER_SURFELS];
    const uint32_t source = surfels->transfer
                                ? transfer_source(&t->views[TRANSFER_SURFELS], point, direction)
                                : LMP_TRANSFER_NONE;
    if (source == LMP_TRANSFER_NONE)
        return (lmp_rgb) { 0, 0, 0 };
    const lmp_transfer_surfel *s = &surfels->points.at[source];
    return reflected_by(t, source,
                        lmp_transfer_irradiance(surfels->transfer, source, s->position, s->normal));
}
