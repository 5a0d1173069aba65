/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer.h"

#include "app/base/timing.h"
#include "app/render/shade.h"
#include "app/render/shadow/transfer_direct.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

struct transfer {
    transfer_settings settings;
    transfer_surfels surfels;
    transfer_cells cells;
    transfer_view view;
    lmp_transfer *transfer; /* NULL in a scene without surfaces */
    lmp_rgb *direct;
    scene_light *lights; /* by which surfels are lit */
    size_t light_count;
    bool lit;
    transfer_statistics statistics;
};

/* --- creation --------------------------------------------------------------------------------- */

static lmp_result make_transfer(transfer *t, const transfer_lists *lists) {
    const lmp_transfer_desc desc = { .surfels = t->surfels.at,
                                     .surfel_count = t->surfels.count,
                                     .hits = lists->hits,
                                     .ray_count = TRANSFER_RAYS,
                                     .links = lists->links,
                                     .link_count = TRANSFER_LINKS };
    return lmp_transfer_create(NULL, &desc, &t->transfer);
}

static bool create_parts(transfer *t, const scene *world, const trace_bvh *bvh) {
    transfer_lists lists = { NULL, NULL };
    if (!transfer_surfels_make(world, &t->surfels))
        return false;
    transfer_drop_buried(world, bvh, &t->surfels);
    if (t->surfels.count == 0)
        return true;
    t->view = (transfer_view) { world, bvh, &t->cells };
    t->direct = malloc(t->surfels.count * sizeof *t->direct);
    t->lights = malloc(SCENE_LIGHTS_MAX * sizeof *t->lights);
    const bool made = t->direct && t->lights && transfer_cells_create(&t->surfels, &t->cells) &&
                      transfer_lists_create(&t->view, &lists) && make_transfer(t, &lists) == LMP_OK;
    transfer_lists_free(&lists);
    return made;
}

transfer *transfer_create(const scene *world, const trace_bvh *bvh,
                          const transfer_settings *settings, base_error *error) {
    const double start = timing_now();
    transfer *t = calloc(1, sizeof *t);
    if (t && bvh && create_parts(t, world, bvh)) {
        t->settings = *settings;
        t->statistics.surfels = t->surfels.count;
        t->statistics.spacing = t->surfels.spacing;
        t->statistics.bytes = t->transfer ? lmp_transfer_describe(t->transfer).bytes : 0;
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
    lmp_transfer_destroy(t->transfer);
    transfer_cells_free(&t->cells);
    free(t->surfels.at);
    free(t->direct);
    free(t->lights);
    free(t);
}

transfer_statistics transfer_describe(const transfer *t) {
    return t->statistics;
}

/* --- the light of a frame --------------------------------------------------------------------- */

static bool are_lights_kept(const transfer *t, const render_frame *frame) {
    return t->lit && t->light_count == frame->light_count &&
           memcmp(t->lights, frame->lights, t->light_count * sizeof *t->lights) == 0;
}

/* Lights the surfels and lets the light bounce, from darkness, so that a frame does not depend on
 * those before it. One thread bounces: it takes milliseconds, and threads would wait for each other
 * after every iteration. */
static bool follow_lights(transfer *t, const render_frame *frame) {
    const double start = timing_now();
    const lmp_transfer_settings settings = { .iterations = t->settings.bounces };
    const lmp_transfer_lighting lighting = { .direct = t->direct };
    t->lit = false;
    if (!transfer_light_directly(&t->view, frame, t->settings.around, t->settings.shadows,
                                 t->direct))
        return false;
    const double lit = timing_now();
    lmp_transfer_reset(t->transfer);
    if (lmp_transfer_update(NULL, t->transfer, &settings, &lighting) != LMP_OK)
        return false;
    t->statistics.light_milliseconds = 1e3 * (lit - start);
    t->statistics.bounce_milliseconds = 1e3 * (timing_now() - lit);
    memcpy(t->lights, frame->lights, frame->light_count * sizeof *t->lights);
    t->light_count = frame->light_count;
    t->lit = true;
    return true;
}

/* --- surfaces --------------------------------------------------------------------------------- */

/* Adds the bounced light of surfaces next to each other in a row of the tile: the irradiance as if
 * it came evenly from all sides, so that every material reflects it. */
static void add_span(const transfer *t, const lmp_shade_settings *settings, const render_tile *tile,
                     bool layered, size_t first, size_t count, float *rgba) {
    static const float white[3] = { 3.5449077f, 3.5449077f, 3.5449077f }; /* 2 sqrt(pi) */
    const lmp_environment even = { white, 1 };
    lmp_rgb reflected[RENDER_TILE];
    float *const *const p = tile->position, *const *const n = tile->normal,
                        *const *const v = tile->view, *const *const coat = tile->coat_normal;
    lmp_surfaces surfaces = {
        .position = { p[0] + first, p[1] + first, p[2] + first, sizeof(float) },
        .normal = { n[0] + first, n[1] + first, n[2] + first, sizeof(float) },
        .view = { v[0] + first, v[1] + first, v[2] + first, sizeof(float) },
        .material = tile->material + first,
        .material_stride = sizeof *tile->material,
    };
    if (layered)
        surfaces.coat_normal =
            (lmp_vec3_array) { coat[0] + first, coat[1] + first, coat[2] + first, sizeof(float) };
    lmp_shade_environment_n(settings, &surfaces, count, &even, lmp_rgb_array_of(reflected));
    for (size_t i = 0; i < count; i++) {
        const size_t at = first + i;
        const lmp_vec3 point = vec(p[0][at], p[1][at], p[2][at]);
        const lmp_vec3 normal = vec(n[0][at], n[1][at], n[2][at]);
        const uint32_t nearest = transfer_nearest(&t->view, point, normal);
        if (nearest == LMP_TRANSFER_NONE)
            continue;
        const lmp_rgb e = lmp_transfer_irradiance(t->transfer, nearest, point, normal);
        rgba[4 * i] += reflected[i].r * e.r / PI;
        rgba[4 * i + 1] += reflected[i].g * e.g / PI;
        rgba[4 * i + 2] += reflected[i].b * e.b / PI;
    }
}

/* What all tiles of an image share. */
typedef struct tiled_image {
    const transfer *transfer;
    const render_surfaces *surfaces;
    lmp_shade_settings settings;
    float *rgba;
} tiled_image;

static void add_tile(const render_rectangle *pixels, render_tile *tile, void *user) {
    const tiled_image *whole = user;
    const render_surfaces *s = whole->surfaces;
    const size_t width = (size_t)pixels->width;
    render_surfaces_tile(s, pixels->x, pixels->y, pixels->width, pixels->height, tile);
    for (int y = 0; y < pixels->height; y++) {
        const size_t row = (size_t)y * width;
        float *to = whole->rgba + 4 * render_surfaces_at(s, pixels->x, pixels->y + y);
        for (size_t x = 0, end; x < width; x = end) {
            end = x + 1;
            if (tile->kind[row + x] != RENDER_SURFACE)
                continue;
            while (end < width && tile->kind[row + end] == RENDER_SURFACE)
                end++;
            add_span(whole->transfer, &whole->settings, tile, s->layered, row + x, end - x,
                     to + 4 * x);
        }
    }
}

static bool add_bounces(const transfer *t, const render_frame *frame, const render_surfaces *s,
                        float *rgba) {
    tiled_image whole = { t,
                          s,
                          { .method = method_table[frame->method].method,
                            .bands = frame->bands,
                            .window = frame->window,
                            .lobe = frame->lobes },
                          rgba };
    return render_tiles_visit(s->width, s->height, add_tile, &whole);
}

static bool run(void *user, const render_frame *frame, const render_surfaces *s, float *rgba,
                base_error *error) {
    transfer *t = user;
    const render_pass *before = &t->settings.before;
    if (before->run && !before->run(before->user, frame, s, rgba, error))
        return false;
    if (!t->transfer)
        return true;
    if (!are_lights_kept(t, frame) && !follow_lights(t, frame))
        return base_fail(error, NULL, "out of memory");
    const double start = timing_now();
    const bool ok = add_bounces(t, frame, s, rgba);
    t->statistics.read_milliseconds = 1e3 * (timing_now() - start);
    return ok || base_fail(error, NULL, "out of memory");
}

render_pass transfer_pass(transfer *t) {
    return (render_pass) { .run = run, .user = t };
}
