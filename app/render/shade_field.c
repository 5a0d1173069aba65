/* SPDX-License-Identifier: MIT */
#include "app/render/shade_field.h"
#include "app/base/timing.h"
#include "app/render/shade_lights.h"
#include "app/scene/bake.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct shade_field {
    lmp_field *nodes;
    size_t *moved; /* indices of lights, SCENE_LIGHTS_MAX */
    lmp_light *to; /* the new values of the moved lights */
    bool moves, forgotten;
    bool whole;     /* whether every node is computed */
    uint64_t stamp; /* as in render_whole_field; 0: changed since */
    shade_field_statistics last;
};

/* --- the grid --------------------------------------------------------------------------------- */

static uint64_t count_nodes(const float extent[3], float edge, int nodes[3]) {
    uint64_t all = 1;
    for (int a = 0; a < 3; a++) {
        const float cells = fminf(ceilf(extent[a] / edge), LMP_FIELD_NODES_MAX);
        nodes[a] = cells > 1 ? (int)cells + 1 : 2;
        all *= (uint64_t)nodes[a];
    }
    return all;
}

/* Returns the edge of the smallest cubic cells that need at most `most` nodes. */
static float choose_edge(const float extent[3], uint64_t most, int nodes[3]) {
    const float longest = fmaxf(extent[0], fmaxf(extent[1], extent[2]));
    float small = longest / (LMP_FIELD_NODES_MAX - 1), large = longest;
    for (int i = 0; i < 24; i++) {
        const float middle = 0.5f * (small + large);
        if (count_nodes(extent, middle, nodes) > most)
            small = middle;
        else
            large = middle;
    }
    count_nodes(extent, large, nodes);
    return large;
}

/* Returns the most nodes: no more than a shader can read. */
static uint64_t most_nodes(const shade_field_options *options, int bands) {
    const uint64_t held = options->bytes_max / (48 * LMP_SH_COUNT(bands));
    return options->bytes_max && held < SHADE_FIELD_NODES ? held : SHADE_FIELD_NODES;
}

/* Describes a grid around the scene's bounds and a little more, so that rounding leaves no surface
 * outside. */
static lmp_field_desc describe_grid(const scene *world, const shade_field_options *options,
                                    int bands) {
    lmp_field_desc desc = { .bands = bands,
                            .light_max = SCENE_LIGHTS_MAX,
                            .error = options->error };
    float extent[3], origin[3], cell[3], longest = 1e-6f;
    for (int a = 0; a < 3; a++)
        longest = fmaxf(longest, world->maximum[a] - world->minimum[a]);
    for (int a = 0; a < 3; a++) {
        const float margin = 1e-3f * longest;
        origin[a] = world->minimum[a] - margin;
        extent[a] = world->maximum[a] - world->minimum[a] + 2 * margin;
    }
    const float edge =
        options->grid_given ? 0 : choose_edge(extent, most_nodes(options, bands), desc.nodes);
    for (int a = 0; a < 3; a++) {
        if (options->grid_given)
            desc.nodes[a] = options->grid[a];
        cell[a] = edge > 0 ? edge : extent[a] / (float)(desc.nodes[a] - 1);
    }
    desc.origin = (lmp_vec3) { origin[0], origin[1], origin[2] };
    desc.cell = (lmp_vec3) { cell[0], cell[1], cell[2] };
    return desc;
}

static bool fail(const lmp_field_desc *desc, lmp_result result, base_error *error) {
    const int *n = desc->nodes;
    if (result == LMP_ERROR_MEMORY)
        return base_fail(
            error, NULL,
            "out of memory for a field of %dx%dx%d nodes (take a smaller --field-grid)", n[0], n[1],
            n[2]);
    return base_fail(error, NULL,
                     "no field has %dx%dx%d nodes and an error of %g (--field-grid, --field-error)",
                     n[0], n[1], n[2], (double)desc->error);
}

shade_field *shade_field_create(const scene *world, const shade_field_options *options, int bands,
                                base_error *error) {
    const lmp_field_desc desc = describe_grid(world, options, bands);
    shade_field *field = calloc(1, sizeof *field);
    if (field) {
        field->moved = malloc(SCENE_LIGHTS_MAX * sizeof *field->moved);
        field->to = malloc(SCENE_LIGHTS_MAX * sizeof *field->to);
    }
    const lmp_result result = field && field->moved && field->to
                                  ? lmp_field_create(NULL, &desc, &field->nodes)
                                  : LMP_ERROR_MEMORY;
    if (result == LMP_OK) {
        field->moves = options->moves;
        return field;
    }
    shade_field_destroy(field);
    fail(&desc, result, error);
    return NULL;
}

void shade_field_destroy(shade_field *field) {
    if (!field)
        return;
    lmp_field_destroy(field->nodes);
    free(field->moved);
    free(field->to);
    free(field);
}

shade_field_statistics shade_field_describe(const shade_field *field) {
    shade_field_statistics statistics = field->last;
    statistics.info = lmp_field_describe(field->nodes);
    return statistics;
}

void shade_field_forget(shade_field *field) {
    if (field)
        field->forgotten = true;
}

/* --- a frame ---------------------------------------------------------------------------------- */

/* Updates the lights. A moved light costs two passes over its nodes, so from half of the lights on,
 * all nodes are recomputed. */
static void follow_lights(shade_field *field, const lmp_host *host, const lmp_light *lights,
                          size_t count) {
    const lmp_light *held = lmp_field_lights(field->nodes);
    size_t moved = 0;
    bool recompute = field->forgotten || lmp_field_describe(field->nodes).light_count != count;
    field->forgotten = false;
    for (size_t i = 0; i < count && !recompute; i++)
        if (memcmp(&held[i], &lights[i], sizeof *lights) != 0) {
            field->moved[moved] = i;
            field->to[moved++] = lights[i];
            recompute = !field->moves || 2 * moved > count;
        }
    if (recompute || moved > 0)
        field->stamp = 0;
    if (recompute) {
        lmp_field_reset(field->nodes, lights, count);
        field->whole = false;
    } else
        lmp_field_move_n(host, field->nodes, field->moved, field->to, moved);
}

bool shade_want_surfaces(lmp_field *nodes, void *user) {
    const render_surfaces *surfaces = user;
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        render_tile row;
        const bool mine = render_tile_create(surfaces->width, &row);
#pragma omp for schedule(dynamic, 16)
        for (int y = 0; y < surfaces->height; y++) {
            if (!mine)
                continue;
            const size_t count = render_surfaces_positions(surfaces, surfaces->y + y, &row);
            const lmp_vec3_array points = { row.position[0], row.position[1], row.position[2],
                                            sizeof(float) };
            lmp_field_want_n(nodes, points, count);
        }
        if (mine)
            render_tile_free(&row);
        ok = mine;
    }
    return ok;
}

const lmp_field *shade_field_follow(shade_field *field, const lmp_light *lights, size_t count,
                                    shade_want *want, void *user) {
    double start = timing_now();
    const char *what = "lighting the field";
    lmp_host host = bake_host(&what);
    host.progress = NULL;
    follow_lights(field, &host, lights, count);
    const double followed = timing_now();
    if (!want(field->nodes, user))
        return NULL;
    start += timing_now() - followed;
    if (lmp_field_compute(&host, field->nodes) != LMP_OK)
        return NULL;
    field->last.update_milliseconds = 1e3 * (timing_now() - start);
    return field->nodes;
}

/* Requests all nodes, by a point in each cell. */
static void want_all(lmp_field *nodes) {
    const lmp_field_desc d = lmp_field_describe(nodes).desc;
    const size_t count = (size_t)d.nodes[0] - 1;
    float x[LMP_FIELD_NODES_MAX];
    for (size_t i = 0; i < count; i++)
        x[i] = d.origin.x + ((float)i + 0.5f) * d.cell.x;
    for (int k = 0; k + 1 < d.nodes[2]; k++)
        for (int j = 0; j + 1 < d.nodes[1]; j++) {
            float y[LMP_FIELD_NODES_MAX], z[LMP_FIELD_NODES_MAX];
            for (size_t i = 0; i < count; i++) {
                y[i] = d.origin.y + ((float)j + 0.5f) * d.cell.y;
                z[i] = d.origin.z + ((float)k + 0.5f) * d.cell.z;
            }
            lmp_field_want_n(nodes, (lmp_vec3_array) { x, y, z, sizeof *x }, count);
        }
}

/* Updates the field for shaders, with all of its nodes, because only the device knows what the
 * camera sees; or with none. */
static const lmp_field *whole_field(const render_frame *frame, bool nodes, uint64_t *stamp) {
    static uint64_t stamps;
    shade_field *field = frame->field;
    const double start = timing_now();
    lmp_light *lights = shade_lights(frame);
    bool ok = lights != NULL;
    const char *what = "lighting the field";
    lmp_host host = bake_host(&what);
    host.progress = NULL;
    if (ok)
        follow_lights(field, &host, lights, frame->light_count);
    free(lights);
    if (ok && nodes && !field->whole) {
        want_all(field->nodes);
        ok = lmp_field_compute(&host, field->nodes) == LMP_OK;
        field->whole = ok;
    }
    if (field->stamp == 0)
        field->stamp = ++stamps;
    *stamp = field->stamp;
    field->last.update_milliseconds = 1e3 * (timing_now() - start);
    return ok ? field->nodes : NULL;
}

void shade_field_attach(shade_field *field, render_frame *frame) {
    frame->field = field;
    frame->whole_field = whole_field;
}

void shade_field_note(shade_field *field, double milliseconds) {
    field->last.evaluate_milliseconds = milliseconds;
}
