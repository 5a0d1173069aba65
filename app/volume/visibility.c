/* SPDX-License-Identifier: MIT */
#include "app/volume/visibility.h"

#include "app/scene/vector.h"
#include "app/shadow/source.h"

#include <stdlib.h>

struct volume_visibility {
    const scene *world;
    trace_bvh *bvh;
    shadow_around around;
    int rays;
    float lift;
};

volume_visibility *volume_visibility_create(const scene *world, const environment *surroundings,
                                            int rays) {
    volume_visibility *v = calloc(1, sizeof *v);
    if (!v)
        return NULL;
    v->world = world;
    v->rays = rays;
    v->lift = (float)trace_lift(world);
    v->bvh = trace_create(world);
    if (v->bvh && shadow_around_create(surroundings, &v->around))
        return v;
    volume_visibility_destroy(v);
    return NULL;
}

void volume_visibility_destroy(volume_visibility *v) {
    if (!v)
        return;
    trace_destroy(v->bvh);
    shadow_around_free(&v->around);
    free(v);
}

/* --- rays ------------------------------------------------------------------------------------- */

/* What would arrive, and what does. */
typedef struct arrival {
    double all, unhidden;
} arrival;

/* Rays first … first + TRACE_LANES - 1 of v->rays, spread evenly over the source. */
static void send_rays(const volume_visibility *v, const shadow_source *source, lmp_vec3 point,
                      int first, arrival *sum) {
    trace_rays rays;
    trace_hit hits[TRACE_LANES];
    float arrives[TRACE_LANES];
    for (int i = 0; i < TRACE_LANES; i++) {
        const bool sent = first + i < v->rays;
        const float number = (float)(first + i), golden = 0.618033989f * number;
        const shadow_sample sample = shadow_source_draw(
            source, point, sent ? (number + 0.5f) / (float)v->rays : 0, golden - floorf(golden));
        arrives[i] = sent ? sample.arrives.r + sample.arrives.g + sample.arrives.b : 0;
        rays.length[i] = sent ? fmaxf(sample.length - v->lift, 0) : -1;
        for (int a = 0; a < 3; a++) {
            rays.origin[a][i] = (&point.x)[a];
            rays.direction[a][i] = (&sample.direction.x)[a];
        }
    }
    trace_nearest_n(v->bvh, TRACE_LIGHT, &rays, hits);
    for (int i = 0; i < TRACE_LANES; i++) {
        sum->all += (double)arrives[i];
        sum->unhidden += hits[i].mesh == TRACE_NOTHING ? (double)arrives[i] : 0;
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
    for (size_t i = 0; i < v->world->light_count; i++) {
        /* the second source of a light is the lower half of a hemisphere */
        const size_t count = shadow_sources_make(&v->world->lights[i], 1, NULL, sources);
        seen[i] = v->world->lights[i].emitter;
        for (size_t k = 0; k < count; k++) {
            lmp_rgb *color = k == 0 ? &seen[i].radiance : &seen[i].ground;
            *color = rgb_scale(*color, visible_fraction(v, &sources[k], point));
        }
    }
    if (!shadow_around_shines(&v->around))
        return 1;
    shadow_sources_make(NULL, 0, &v->around, sources);
    return visible_fraction(v, &sources[0], point);
}
