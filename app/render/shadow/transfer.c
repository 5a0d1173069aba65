/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer.h"

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
    transfer_view view;
    lmp_rgb *direct;
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
    t->view = (transfer_view) { world, bvh, &t->baked->cells };
    t->direct = malloc((t->baked->surfels.count + 1) * sizeof *t->direct);
    t->lights = malloc(SCENE_LIGHTS_MAX * sizeof *t->lights);
    t->new_lights = malloc(SCENE_LIGHTS_MAX * sizeof *t->new_lights);
    return t->direct && t->lights && t->new_lights;
}

transfer *transfer_create(const scene *world, const lmp_rgb *albedos, const trace_bvh *bvh,
                          const transfer_settings *settings, base_error *error) {
    const double start = timing_now();
    transfer *t = calloc(1, sizeof *t);
    if (t && bvh && create_parts(t, world, albedos, bvh)) {
        const transfer_baked *b = t->baked;
        t->settings = *settings;
        t->statistics.surfels = b->surfels.count;
        t->statistics.spacing = b->surfels.spacing;
        t->statistics.bytes = b->transfer ? lmp_transfer_describe(b->transfer).bytes : 0;
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

/* Lights the surfels and lets the light bounce, from darkness, so that a frame does not depend on
 * those before it. One thread bounces: it takes milliseconds, and threads would wait for each other
 * after every iteration. */
static bool follow_lights(transfer *t, const render_frame *frame) {
    const double start = timing_now();
    const lmp_transfer_settings settings = { .iterations = t->settings.bounces };
    const lmp_transfer_lighting lighting = { .direct = t->direct };
    const transfer_way way = { t->settings.around, t->settings.shadows, t->settings.quick };
    if (!transfer_light_directly(&t->view, frame, &way, t->direct))
        return false;
    const double lit = timing_now();
    lmp_transfer_reset(t->baked->transfer);
    if (settings.iterations > 0 &&
        lmp_transfer_update(NULL, t->baked->transfer, &settings, &lighting) != LMP_OK)
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
    transfer_read(&t->view, t->baked->transfer, surfaces, pixels, tile);
}

render_bounces transfer_bounces(transfer *t) {
    return t->baked->transfer ? (render_bounces) { .begin = begin, .fill = fill, .user = t }
                              : (render_bounces) { .user = NULL };
}

/* --- from a point ----------------------------------------------------------------------------- */

lmp_rgb transfer_radiance(const transfer *t, lmp_vec3 point, lmp_vec3 direction) {
    const uint32_t source =
        t->baked->transfer ? transfer_source(&t->view, point, direction) : LMP_TRANSFER_NONE;
    if (source == LMP_TRANSFER_NONE)
        return (lmp_rgb) { 0, 0, 0 };
    const lmp_transfer_surfel *s = &t->baked->surfels.at[source];
    const lmp_rgb indirect =
        lmp_transfer_irradiance(t->baked->transfer, source, s->position, s->normal);
    const lmp_rgb direct = t->direct[source];
    const float per_pi = (float)M_1_PI;
    return (lmp_rgb) { per_pi * s->albedo.r * (direct.r + indirect.r),
                       per_pi * s->albedo.g * (direct.g + indirect.g),
                       per_pi * s->albedo.b * (direct.b + indirect.b) };
}
