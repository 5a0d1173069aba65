/* SPDX-License-Identifier: MIT */
#include "app/study/volume_visibility.h"

#include "app/render/shadow/source.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

struct volume_visibility {
    const scene *world;
    const trace_bvh *bvh;
    shadow_around around;
    int rays;
    float lift;
};

volume_visibility *volume_visibility_create(const scene *world, const trace_bvh *bvh,
                                            const environment *surroundings, int rays) {
    volume_visibility *v = calloc(1, sizeof *v);
    if (!v)
        return NULL;
    v->world = world;
    v->rays = rays;
    v->lift = (float)trace_lift(world);
    v->bvh = bvh;
    if (shadow_around_create(surroundings, &v->around))
        return v;
    volume_visibility_destroy(v);
    return NULL;
}

void volume_visibility_destroy(volume_visibility *v) {
    if (!v)
        return;
    shadow_around_free(&v->around);
    free(v);
}

/* --- rays ------------------------------------------------------------------------------------- */

/* The light that would arrive, and the light that does. */
typedef struct arrival {
    double all, unhidden;
} arrival;

/* Sends rays first … first + TRACE_LANES - 1 of v->rays, spread evenly over the source. */
static void send_rays(const volume_visibility *v, const shadow_source *source, lmp_vec3 point,
                      int first, arrival *sum) {
    const shadow_source *sources[TRACE_LANES];
    shadow_vectors points;
    shadow_lanes along, around;
    shadow_samples samples;
    trace_rays rays;
    bool occluded[TRACE_LANES];
    for (int i = 0; i < TRACE_LANES; i++) {
        const float number = (float)(first + i), golden = 0.618033989f * number;
        sources[i] = source;
        shadow_set_lane(&points, i, point);
        along[i] = first + i < v->rays ? (number + 0.5f) / (float)v->rays : 0;
        around[i] = golden - floorf(golden);
    }
    shadow_sources_draw(sources, &points, NULL, along, around, &samples);
    rays.together = source->kind != SHADOW_AROUND;
    memcpy(rays.origin, points.of, sizeof rays.origin);
    memcpy(rays.direction, samples.direction.of, sizeof rays.direction);
    for (int i = 0; i < TRACE_LANES; i++) {
        rays.start[i] = 0;
        rays.length[i] = first + i < v->rays ? fmaxf(samples.length[i] - v->lift, 0) : -1;
    }
    trace_occluded_n(v->bvh, &rays, occluded);
    for (int i = 0; i < TRACE_LANES && first + i < v->rays; i++) {
        const lmp_vec3 rgb = shadow_lane(&samples.arrives, i);
        const float arrives = rgb.x + rgb.y + rgb.z;
        sum->all += (double)arrives;
        sum->unhidden += occluded[i] ? 0 : (double)arrives;
    }
}

static float visible_fraction(const volume_visibility *v, const shadow_source *source,
                              lmp_vec3 point) {
    arrival sum = { 0 };
    for (int first = 0; first < v->rays; first += TRACE_LANES)
        send_rays(v, source, point, first, &sum);
    return sum.all > 0 ? (float)(sum.unhidden / sum.all) : 1;
}

/* --- lights ----------------------------------------------------------------------------------- */

float volume_visible_lights(const volume_visibility *v, lmp_vec3 point, lmp_light *seen) {
    shadow_source sources[SHADOW_SOURCES(1)];
    scene_emitter area;
    for (size_t i = 0; i < v->world->light_count; i++) {
        /* a light's second source is the lower half of a hemisphere light */
        const size_t count = shadow_sources_make(&v->world->lights[i], 1, NULL, &area, sources);
        seen[i] = v->world->lights[i].emitter;
        for (size_t k = 0; k < count; k++) {
            lmp_rgb *color = k == 0 ? &seen[i].radiance : &seen[i].ground;
            *color = rgb_scale(*color, visible_fraction(v, &sources[k], point));
        }
    }
    if (!shadow_around_shines(&v->around))
        return 1;
    shadow_sources_make(NULL, 0, &v->around, &area, sources);
    return visible_fraction(v, &sources[0], point);
}
