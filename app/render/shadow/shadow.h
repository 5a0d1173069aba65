/* SPDX-License-Identifier: MIT */
/* shadow.h - shadows by the ratio estimator (Heitz, Hill and McGuire 2018): the light that surfaces
 * reflect is computed without noise, and multiplied by the fraction that arrives, which a few rays
 * per pixel and a filter estimate. See docs/shadows.md.
 *
 * There is no other way of casting shadows yet: one would be another render_pass
 * (app/render/frame.h), which app/command/render.c and app/view/compositor.c set and
 * app/command/render_stats.c reports. It gets surfaces in memory; shadows by shaders would be a
 * pass of app/render/gl/renderer.c. */
#ifndef LAMPION_RENDER_SHADOW_SHADOW_H
#define LAMPION_RENDER_SHADOW_SHADOW_H

#include "app/render/surfaces.h"
#include "app/scene/trace/trace.h"

typedef struct shadow_settings {
    int rays;      /* per pixel, 1 … SHADOW_RAYS_MAX; 0: automatic */
    uint32_t seed; /* of the noise; a seed gives the same bits on any number of threads */
    bool raw;      /* whether to skip the filter */
    bool sparse;   /* whether only one of two neighboring pixels sends rays */
    bool apart;    /* samples are independent: all send rays, not one in three */
} shadow_settings;
#define SHADOW_RAYS_MAX    1024
#define SHADOW_RAYS_APART  1 /* default for independent samples */
#define SHADOW_RAYS_USUAL  2
#define SHADOW_RAYS_AROUND 4 /* factor where an environment shines, which is all penumbra */

/* Statistics of the last sample that sent rays. */
typedef struct shadow_statistics {
    int rays_a_pixel;
    size_t rays;                                   /* toward lights */
    double rays_milliseconds, filter_milliseconds; /* of parallel threads: their mean */
} shadow_statistics;

typedef struct shadow shadow;

/* Creates the shadows of a scene, whose tree and environment, which may be NULL, must outlive them;
 * returns NULL on failure. */
shadow *shadow_create(const scene *scene, const trace_bvh *bvh, const environment *surroundings,
                      const shadow_settings *settings, base_error *error);
void shadow_destroy(shadow *shadow);

/* Replaces the environment, or removes it if NULL. Returns false if memory ran out; there is then
 * none. */
bool shadow_surround(shadow *shadow, const environment *surroundings, base_error *error);

/* Returns the pass that draws shadows in a frame. */
render_pass shadow_pass(shadow *shadow);

shadow_statistics shadow_describe(const shadow *shadow);

#endif
