/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_direct.h"

#include "app/render/shade_lights.h"
#include "app/render/shadow/source.h"
#include "app/scene/vector.h"

#include <lampion/probe.h>

#include <stdlib.h>

/* --- without shadows -------------------------------------------------------------------------- */

static bool light_openly(const transfer_surfels *surfels, const render_frame *frame,
                         const environment *around, lmp_rgb *direct) {
    lmp_light *lights = shade_lights(frame);
    if (!lights)
        return false;
#pragma omp parallel for schedule(dynamic, 64)
    for (ptrdiff_t i = 0; i < (ptrdiff_t)surfels->count; i++) {
        const lmp_transfer_surfel *at = &surfels->at[i];
        direct[i] = lmp_light_irradiance(lights, frame->light_count, at->position, at->normal);
        if (environment_shines(around)) {
            const lmp_rgb e = lmp_probe_irradiance(around->bands, around->sh, at->normal);
            direct[i].r += e.r;
            direct[i].g += e.g;
            direct[i].b += e.b;
        }
    }
    free(lights);
    return true;
}

/* --- with shadows ----------------------------------------------------------------------------- */

/* Surfels side by side. */
typedef struct surfel_lanes {
    size_t first;
    int count;
    shadow_vectors position, normal, origin;
    shadow_vectors sum;
} surfel_lanes;

static void load_lanes(const transfer_view *view, size_t first, float lift, surfel_lanes *lanes) {
    const transfer_surfels *surfels = view->cells->surfels;
    const size_t left = surfels->count - first;
    *lanes =
        (surfel_lanes) { .first = first, .count = left < SHADOW_LANES ? (int)left : SHADOW_LANES };
    for (int i = 0; i < SHADOW_LANES; i++) {
        const size_t lane = (size_t)(i < lanes->count ? i : 0);
        const lmp_transfer_surfel *at = &surfels->at[first + lane];
        shadow_set_lane(&lanes->position, i, at->position);
        shadow_set_lane(&lanes->normal, i, at->normal);
        shadow_set_lane(&lanes->origin, i, vec_add(at->position, vec_scale(at->normal, lift)));
    }
}

/* Adds a sample of a source to each surfel, by one ray each. */
static void add_sample(const transfer_view *view, const shadow_source *source, uint32_t number,
                       float scale, surfel_lanes *lanes) {
    const shadow_source *sources[SHADOW_LANES];
    shadow_lanes u, v, cosine;
    shadow_samples samples;
    trace_rays rays;
    trace_hit hits[TRACE_LANES];
    for (int i = 0; i < SHADOW_LANES; i++) {
        double xy[2];
        transfer_sequence((double)number, (double)(lanes->first + (size_t)i), xy);
        u[i] = (float)(xy[0] - floor(xy[0]));
        v[i] = (float)(xy[1] - floor(xy[1]));
        sources[i] = source;
    }
    shadow_sources_draw(sources, &lanes->position, NULL, u, v, &samples);
    rays.together = false;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_vec3 w = shadow_lane(&samples.direction, i),
                       from = shadow_lane(&lanes->origin, i);
        const float origin[3] = { from.x, from.y, from.z }, along[3] = { w.x, w.y, w.z };
        cosine[i] = vec_dot(w, shadow_lane(&lanes->normal, i));
        for (int c = 0; c < 3; c++) {
            rays.origin[c][i] = origin[c];
            rays.direction[c][i] = along[c];
        }
        rays.start[i] = 0;
        rays.length[i] = i < lanes->count && cosine[i] > 0 ? samples.length[i] : -1;
    }
    trace_nearest_n(view->bvh, TRACE_LIGHT, &rays, hits);
    for (int i = 0; i < lanes->count; i++)
        if (rays.length[i] > 0 && hits[i].instance == TRACE_NOTHING) {
            const lmp_vec3 arrives = shadow_lane(&samples.arrives, i);
            const float factor = scale * cosine[i];
            if (isfinite(factor * (arrives.x + arrives.y + arrives.z)))
                shadow_set_lane(&lanes->sum, i,
                                vec_add(shadow_lane(&lanes->sum, i), vec_scale(arrives, factor)));
        }
}

/* Returns how many rays a surfel sends to a source: more to an environment, which is all penumbra,
 * and fewer where there are many lights, whose noise evens out. */
static uint32_t samples_of(const shadow_source *source, size_t source_count, bool quick) {
    enum { AROUND = 64, LIGHTS = 128, LIGHT_MAX = 16, QUICK = 8 };
    const size_t each = LIGHTS / source_count / (quick ? QUICK : 1),
                 most = quick ? LIGHT_MAX / QUICK : LIGHT_MAX;
    if (source->kind == SHADOW_AROUND)
        return quick ? AROUND / QUICK : AROUND;
    return each < 1 ? 1 : each > most ? (uint32_t)most : (uint32_t)each;
}

static void light_lanes(const transfer_view *view, const shadow_source *sources, size_t count,
                        bool quick, float lift, size_t first, lmp_rgb *direct) {
    surfel_lanes lanes;
    load_lanes(view, first, lift, &lanes);
    for (size_t s = 0; s < count; s++) {
        const uint32_t samples = samples_of(&sources[s], count, quick);
        for (uint32_t k = 0; k < samples; k++)
            add_sample(view, &sources[s], k, 1 / (float)samples, &lanes);
    }
    for (int i = 0; i < lanes.count; i++) {
        const lmp_vec3 sum = shadow_lane(&lanes.sum, i);
        direct[first + (size_t)i] = (lmp_rgb) { sum.x, sum.y, sum.z };
    }
}

static bool light_by_rays(const transfer_view *view, const render_frame *frame,
                          const transfer_way *way, lmp_rgb *direct) {
    const ptrdiff_t groups =
        (ptrdiff_t)((view->cells->surfels->count + SHADOW_LANES - 1) / SHADOW_LANES);
    const float lift = (float)trace_lift(view->scene);
    scene_emitter *areas = malloc((frame->light_count + 1) * sizeof *areas);
    shadow_source *sources = malloc(SHADOW_SOURCES(frame->light_count) * sizeof *sources);
    shadow_around sampled = { .source = NULL };
    const bool ok = areas && sources && shadow_around_create(way->around, &sampled);
    if (ok) {
        const size_t count =
            shadow_sources_make(frame->lights, frame->light_count,
                                shadow_around_shines(&sampled) ? &sampled : NULL, areas, sources);
#pragma omp parallel for schedule(dynamic, 8)
        for (ptrdiff_t i = 0; i < groups; i++)
            light_lanes(view, sources, count, way->quick, lift, (size_t)i * SHADOW_LANES, direct);
    }
    shadow_around_free(&sampled);
    free(areas);
    free(sources);
    return ok;
}

bool transfer_light_directly(const transfer_view *view, const render_frame *frame,
                             const transfer_way *way, lmp_rgb *direct) {
    return way->shadows ? light_by_rays(view, frame, way, direct)
                        : light_openly(view->cells->surfels, frame, way->around, direct);
}
