/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_direct.h"

#include "app/render/shade_lights.h"
#include "app/render/shadow/source.h"
#include "app/scene/vector.h"

#include <lampion/probe.h>

#include <stdlib.h>
#include <string.h>

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

/* The sources of a frame, and how many rays each surfel sends to them. */
typedef struct lighting {
    const transfer_view *view;
    const shadow_source *sources;
    size_t source_count;
    uint32_t rays;
    float lift;
} lighting;

/* Surfels side by side. */
typedef struct surfel_lanes {
    size_t first;
    int count;
    shadow_points points;
    shadow_vectors sum;
} surfel_lanes;

static void load_lanes(const lighting *l, size_t first, surfel_lanes *lanes) {
    const transfer_surfels *surfels = l->view->cells->surfels;
    const size_t left = surfels->count - first;
    memset(lanes, 0, sizeof *lanes);
    lanes->first = first;
    lanes->count = left < SHADOW_LANES ? (int)left : SHADOW_LANES;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_transfer_surfel *at = &surfels->at[first + (size_t)(i < lanes->count ? i : 0)];
        shadow_points *p = &lanes->points;
        p->albedo[i] = p->alpha2[i] = 1; /* matte and white: what arrives counts */
        shadow_set_lane(&p->position, i, at->position);
        shadow_set_lane(&p->normal, i, at->normal);
        shadow_set_lane(&p->origin, i, vec_add(at->position, vec_scale(at->normal, l->lift)));
    }
}

/* Returns the first source up to which the weights add up to more than `part`. */
static size_t find_source(shadow_lanes *sums, size_t count, int lane, float part) {
    size_t first = 0, end = count - 1;
    while (first < end) {
        const size_t middle = (first + end) / 2;
        if (sums[middle][lane] > part)
            end = middle;
        else
            first = middle + 1;
    }
    return first;
}

/* The sources that surfels send a ray to, and what its light counts. */
typedef struct chosen_lanes {
    const shadow_source *source[SHADOW_LANES];
    shadow_lanes factor;
} chosen_lanes;

/* Chooses the source of ray `number` of each surfel, in proportion to what they bring. */
static void choose_sources(const lighting *l, const surfel_lanes *lanes, shadow_lanes *sums,
                           uint32_t number, chosen_lanes *chosen) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        /* not in step with the directions, which transfer_sequence shifts */
        const double shift = 0.7320508075688772 * (double)(lanes->first + (size_t)i);
        const float all = sums[l->source_count - 1][i],
                    at = ((float)number + (float)(shift - floor(shift))) / (float)l->rays;
        const size_t s = find_source(sums, l->source_count, i, at * all);
        const float weight = sums[s][i] - (s > 0 ? sums[s - 1][i] : 0);
        chosen->source[i] = &l->sources[s];
        chosen->factor[i] = weight > 0 ? all / (weight * (float)l->rays) : 0;
    }
}

/* Adds a sample of the sources to each surfel, by one ray each. */
static void add_sample(const lighting *l, uint32_t number, const chosen_lanes *chosen,
                       surfel_lanes *lanes) {
    shadow_points *p = &lanes->points;
    shadow_lanes u, v, cosine;
    shadow_samples samples;
    trace_rays rays;
    bool occluded[TRACE_LANES];
    for (int i = 0; i < SHADOW_LANES; i++) {
        double xy[2];
        transfer_sequence((double)number, (double)(lanes->first + (size_t)i), xy);
        u[i] = (float)(xy[0] - floor(xy[0]));
        v[i] = (float)(xy[1] - floor(xy[1]));
    }
    shadow_sources_draw(chosen->source, &p->position, NULL, u, v, &samples);
    rays.together = false;
    for (int i = 0; i < SHADOW_LANES; i++) {
        cosine[i] = vec_dot(shadow_lane(&samples.direction, i), shadow_lane(&p->normal, i));
        for (int c = 0; c < 3; c++) {
            rays.origin[c][i] = p->origin.of[c][i];
            rays.direction[c][i] = samples.direction.of[c][i];
        }
        rays.start[i] = 0;
        rays.length[i] =
            i < lanes->count && cosine[i] > 0 && chosen->factor[i] > 0 ? samples.length[i] : -1;
        if (chosen->source[i]->kind == SHADOW_AREA && rays.length[i] >= 0)
            shadow_end_at_area(shadow_lane(&p->position, i), i, &rays);
    }
    trace_occluded_n(l->view->bvh, &rays, occluded);
    for (int i = 0; i < lanes->count; i++)
        if (rays.length[i] > 0 && !occluded[i]) {
            const lmp_vec3 arrives = shadow_lane(&samples.arrives, i);
            const float factor = chosen->factor[i] * cosine[i];
            if (isfinite(factor * (arrives.x + arrives.y + arrives.z)))
                shadow_set_lane(&lanes->sum, i,
                                vec_add(shadow_lane(&lanes->sum, i), vec_scale(arrives, factor)));
        }
}

/* Lights the surfels of a group; `sums` has room for a weight of each source. */
static void light_lanes(const lighting *l, size_t first, shadow_lanes *sums, lmp_rgb *direct) {
    surfel_lanes lanes;
    load_lanes(l, first, &lanes);
    shadow_sources_weigh(l->sources, l->source_count, &lanes.points, sums);
    for (uint32_t k = 0; k < l->rays; k++) {
        chosen_lanes chosen;
        choose_sources(l, &lanes, sums, k, &chosen);
        add_sample(l, k, &chosen, &lanes);
    }
    for (int i = 0; i < lanes.count; i++) {
        const lmp_vec3 sum = shadow_lane(&lanes.sum, i);
        direct[first + (size_t)i] = (lmp_rgb) { sum.x, sum.y, sum.z };
    }
}

/* Returns how many rays a surfel sends: fewer to few lights, whose penumbras alone need them, than
 * to many, or to an environment. */
static uint32_t rays_of(const shadow_source *sources, size_t count, bool quick) {
    enum { MOST = 64, LIGHT = 16, QUICK = 8 };
    const bool around = count > 0 && sources[count - 1].kind == SHADOW_AROUND;
    const size_t wanted = around || count > MOST / LIGHT ? MOST : LIGHT * count;
    return (uint32_t)(quick ? (wanted + QUICK - 1) / QUICK : wanted);
}

static bool light_all(const lighting *l, lmp_rgb *direct) {
    const ptrdiff_t groups =
        (ptrdiff_t)((l->view->cells->surfels->count + SHADOW_LANES - 1) / SHADOW_LANES);
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        shadow_lanes *sums = malloc((l->source_count + 1) * sizeof *sums);
        ok = sums != NULL;
#pragma omp for schedule(dynamic, 8)
        for (ptrdiff_t i = 0; i < groups; i++)
            if (sums)
                light_lanes(l, (size_t)i * SHADOW_LANES, sums, direct);
        free(sums);
    }
    return ok;
}

static bool light_by_rays(const transfer_view *view, const render_frame *frame,
                          const transfer_way *way, lmp_rgb *direct) {
    scene_emitter *areas = malloc((frame->light_count + 1) * sizeof *areas);
    shadow_source *sources = malloc(SHADOW_SOURCES(frame->light_count) * sizeof *sources);
    shadow_around sampled = { .source = NULL };
    bool ok = areas && sources && shadow_around_create(way->around, &sampled);
    if (ok) {
        const size_t count =
            shadow_sources_make(frame->lights, frame->light_count,
                                shadow_around_shines(&sampled) ? &sampled : NULL, areas, sources);
        const lighting l = { view, sources, count, rays_of(sources, count, way->quick),
                             (float)trace_lift(view->scene) };
        memset(direct, 0, view->cells->surfels->count * sizeof *direct);
        ok = count == 0 || light_all(&l, direct);
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
