/* SPDX-License-Identifier: MIT */
#include "app/render/shade/shade.h"
#include "app/render/shade/field.h"
#include "app/render/shade/lights.h"
#include "app/timing/timing.h"

#include <stdlib.h>
#include <string.h>

/* What every pixel of a frame is shaded by. */
typedef struct shading {
    lmp_shade_settings settings;
    const lmp_light *lights;
    size_t light_count;
    const lmp_field *field;         /* of these lights, or NULL */
    const environment *environment; /* or NULL */
    bool layered;
} shading;

static lmp_vec3_array from(const lmp_vec3_array *planes, size_t first) {
    return (lmp_vec3_array) { planes->x + first, planes->y + first, planes->z + first,
                              planes->stride };
}

static lmp_vec3_array vectors(float *const planes[3], size_t first) {
    return (lmp_vec3_array) { planes[0] + first, planes[1] + first, planes[2] + first,
                              sizeof(float) };
}

enum { RUN = 64 };

/* By how much of it comes to each. */
static void add_environment(const shading *s, const lmp_surfaces *all, const float *ambient,
                            size_t count, float *rgba) {
    const lmp_environment light = { s->environment->sh, s->environment->bands };
    for (size_t first = 0; first < count; first += RUN) {
        const size_t some = count - first < RUN ? count - first : RUN;
        lmp_surfaces run = {
            .normal = from(&all->normal, first),
            .view = from(&all->view, first),
            .material = all->material + first,
            .material_stride = all->material_stride,
        };
        if (s->layered)
            run.coat_normal = from(&all->coat_normal, first);
        lmp_rgb reflected[RUN];
        lmp_shade_environment_n(&s->settings, &run, some, &light, 0, &reflected->r);
        for (size_t i = 0; i < some; i++) {
            float *pixel = rgba + 4 * (first + i);
            pixel[0] += reflected[i].r * ambient[first + i];
            pixel[1] += reflected[i].g * ambient[first + i];
            pixel[2] += reflected[i].b * ambient[first + i];
        }
    }
}

/* Neighbors in a tile, from `first` on. */
static void shade_run(const shading *s, const render_tile *row, size_t first, size_t count,
                      float *rgba) {
    lmp_surfaces surfaces = {
        .position = vectors(row->position, first),
        .normal = vectors(row->normal, first),
        .view = vectors(row->view, first),
        .material = row->material + first,
        .material_stride = sizeof *row->material,
    };
    if (s->layered)
        surfaces.coat_normal = vectors(row->coat_normal, first);
    if (s->field)
        lmp_field_shade_n(&s->settings, s->field, &surfaces, count, 4 * sizeof(float), rgba);
    else
        lmp_shade_n(&s->settings, &surfaces, count, s->lights, s->light_count, 4 * sizeof(float),
                    rgba);
    if (s->environment)
        add_environment(s, &surfaces, row->ambient + first, count, rgba);
}

/* Runs of surfaces are shaded together; what lies between them shows what it emits. */
static void shade_pixels(const shading *s, const render_tile *row, size_t count, float *rgba) {
    for (size_t i = 0; i < count;) {
        size_t end = i;
        while (end < count && row->kind[end] == RENDER_SURFACE)
            end++;
        if (end > i)
            shade_run(s, row, i, end - i, rgba + 4 * i);
        for (; i < end; i++)
            for (size_t c = 0; c < 3; c++)
                rgba[4 * i + c] += row->emission[c][i];
        for (; i < count && row->kind[i] != RENDER_SURFACE; i++)
            for (size_t c = 0; c < 3; c++)
                rgba[4 * i + c] = row->emission[c][i];
    }
}

/* Pixels of a tile lie close to each other: near the same lights, in few cells of a field. */
enum { TILE = 32 };

static void shade_tile(const shading *s, const gpu_gbuffer *gbuffer, const int at[2],
                       const int size[2], render_tile *row, float *rgba) {
    float pixels[4 * TILE * TILE] = { 0 };
    const int width = size[0] - at[0] < TILE ? size[0] - at[0] : TILE;
    const int height = size[1] - at[1] < TILE ? size[1] - at[1] : TILE;
    gpu_gbuffer_tile(gbuffer, at[0], at[1], width, height, row);
    shade_pixels(s, row, (size_t)(width * height), pixels);
    for (int y = 0; y < height; y++) {
        float *to = rgba + 4 * ((size_t)(at[1] + y) * (size_t)size[0] + (size_t)at[0]);
        memcpy(to, pixels + 4 * y * width, 4 * (size_t)width * sizeof *to);
    }
}

static bool shade_tiles(const shading *s, const gpu_gbuffer *gbuffer, int width, int height,
                        float *rgba) {
    const int columns = (width + TILE - 1) / TILE, rows = (height + TILE - 1) / TILE;
    const int size[2] = { width, height };
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        render_tile row;
        const bool mine = render_tile_create(TILE * TILE, &row);
#pragma omp for schedule(dynamic)
        for (int i = 0; i < columns * rows; i++)
            if (mine) {
                const int at[2] = { i % columns * TILE, i / columns * TILE };
                shade_tile(s, gbuffer, at, size, &row, rgba);
            }
        if (mine)
            render_tile_free(&row);
        ok = mine;
    }
    return ok;
}

bool shade_frame(const render_frame *frame, const gpu_gbuffer *gbuffer, float *rgba,
                 cli_error *error) {
    const size_t count = frame->light_count;
    const bool by_field = method_table[frame->method].reads & METHOD_READS_FIELD;
    lmp_light *lights = shade_lights(frame);
    shading s = { { .method = method_table[frame->method].method,
                    .bands = frame->bands,
                    .window = frame->window,
                    .lobe = frame->lobes },
                  .lights = lights,
                  .light_count = count,
                  .environment = gpu_gbuffer_environment(gbuffer),
                  .layered = gpu_gbuffer_is_layered(gbuffer) };
    bool ok = lights;
    if (ok && by_field) {
        s.field =
            shade_field_follow(frame->field, lights, count, gbuffer, frame->width, frame->height);
        ok = s.field != NULL;
    }
    const double start = timing_now();
    ok = ok && shade_tiles(&s, gbuffer, frame->width, frame->height, rgba);
    if (by_field)
        shade_field_note(frame->field, 1e3 * (timing_now() - start));
    free(lights);
    return ok || cli_fail(error, NULL, "out of memory");
}

render_shader shade_on(device_kind device) {
    return device_table[device].on_host ? shade_frame : NULL;
}
