/* SPDX-License-Identifier: MIT */
#include "app/render/shade.h"
#include "app/base/timing.h"
#include "app/render/shade_field.h"
#include "app/render/shade_lights.h"
#include "app/scene/trace/wide.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct shade_job {
    const render_frame *frame;
    lmp_shade_settings settings;
    lmp_light *lights;      /* those that the method sums, then areas that zonal sums beside it */
    size_t summed, beside;  /* how many */
    const lmp_field *field; /* of the lights that the method sums, or NULL */
};

static lmp_vec3_array from(const lmp_vec3_array *planes, size_t first) {
    return (lmp_vec3_array) { planes->x + first, planes->y + first, planes->z + first,
                              planes->stride };
}

enum { RUN = 64 };

/* Returns the surfaces from `first` on. */
static lmp_surfaces run_of(const lmp_surfaces *all, size_t first) {
    lmp_surfaces run = {
        .position = from(&all->position, first),
        .normal = from(&all->normal, first),
        .view = from(&all->view, first),
        .material = all->material + first,
        .material_stride = all->material_stride,
    };
    if (all->coat_normal.x)
        run.coat_normal = from(&all->coat_normal, first);
    return run;
}

/* Adds reflected light of the environment, scaled by the fraction that arrives at each surface. */
static void add_environment(const shade_job *job, const environment *around,
                            const lmp_surfaces *all, const float *ambient, size_t count,
                            float *rgba) {
    const lmp_environment light = { around->sh, around->bands };
    for (size_t first = 0; first < count; first += RUN) {
        const size_t some = count - first < RUN ? count - first : RUN;
        const lmp_surfaces run = run_of(all, first);
        lmp_rgb reflected[RUN];
        lmp_shade_environment_n(&job->settings, &run, some, &light, lmp_rgb_array_of(reflected));
        for (size_t i = 0; i < some; i++) {
            float *pixel = rgba + 4 * (first + i);
            pixel[0] += reflected[i].r * ambient[first + i];
            pixel[1] += reflected[i].g * ambient[first + i];
            pixel[2] += reflected[i].b * ambient[first + i];
        }
    }
}

static void add_colors(const lmp_rgb *colors, size_t count, float *rgba) {
    for (size_t i = 0; i < count; i++) {
        rgba[4 * i] += colors[i].r;
        rgba[4 * i + 1] += colors[i].g;
        rgba[4 * i + 2] += colors[i].b;
    }
}

/* Adds the reflected light of the areas that the method does not sum. */
static void add_areas(const shade_job *job, const lmp_surfaces *all, size_t count, float *rgba) {
    lmp_shade_settings settings = job->settings;
    settings.method = LMP_SHADE_ZONAL;
    for (size_t first = 0; first < count; first += RUN) {
        const size_t some = count - first < RUN ? count - first : RUN;
        const lmp_surfaces run = run_of(all, first);
        lmp_rgb reflected[RUN];
        lmp_shade_n(&settings, &run, some, job->lights + job->summed, job->beside,
                    lmp_rgb_array_of(reflected));
        add_colors(reflected, some, rgba + 4 * first);
    }
}

/* Adds the reflected light of all lights and the environment. */
static void light_surfaces(const shade_job *job, const environment *around,
                           const lmp_surfaces *surfaces, const float *ambient, size_t count,
                           float *rgba) {
    if (job->field)
        lmp_field_shade_n(&job->settings, job->field, surfaces, count,
                          (lmp_rgb_array) { rgba, 4 * sizeof(float) });
    else
        lmp_shade_n(&job->settings, surfaces, count, job->lights, job->summed,
                    (lmp_rgb_array) { rgba, 4 * sizeof(float) });
    if (job->beside > 0)
        add_areas(job, surfaces, count, rgba);
    if (environment_shines(around))
        add_environment(job, around, surfaces, ambient, count, rgba);
}

/* Adds light that is transmitted by `count` <= RUN surfaces of a tile: what diffuse surfaces with
 * opposite normals would reflect. */
static void add_transmitted(const shade_job *job, const environment *around,
                            const render_tile *tile, const size_t *at, size_t count, float *rgba) {
    float position[3][RUN], normal[3][RUN], ambient[RUN], through[4 * RUN] = { 0 };
    lmp_material material[RUN];
    for (size_t i = 0; i < count; i++) {
        float *const *const color = tile->transmitted;
        material[i] =
            render_material_matte((lmp_rgb) { color[0][at[i]], color[1][at[i]], color[2][at[i]] });
        ambient[i] = tile->ambient[at[i]];
        for (int c = 0; c < 3; c++) {
            position[c][i] = tile->position[c][at[i]];
            normal[c][i] = -tile->normal[c][at[i]];
        }
    }
    const lmp_vec3_array normals = render_vectors((float *[3]) { normal[0], normal[1], normal[2] });
    const lmp_surfaces surfaces = {
        .position = render_vectors((float *[3]) { position[0], position[1], position[2] }),
        .normal = normals,
        .view = normals,
        .material = material,
        .material_stride = sizeof *material,
    };
    light_surfaces(job, around, &surfaces, ambient, count, through);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            rgba[4 * at[i] + c] += through[4 * i + c];
}

static void add_from_behind(const shade_job *job, const environment *around,
                            const render_tile *tile, size_t count, float *rgba) {
    float *const *const color = tile->transmitted;
    size_t at[RUN], some = 0;
    for (size_t i = 0; i < count; i++) {
        if (color[0][i] > 0 || color[1][i] > 0 || color[2][i] > 0)
            at[some++] = i;
        if (some == RUN || (some > 0 && i + 1 == count)) {
            add_transmitted(job, around, tile, at, some, rgba);
            some = 0;
        }
    }
}

/* Computes the light that the tile's surfaces reflect and transmit, into rgba. */
static void reflect(const shade_job *job, const render_surfaces *planes, const render_tile *tile,
                    size_t count, float *rgba) {
    const lmp_surfaces surfaces = render_tile_surfaces(tile, planes->layered);
    light_surfaces(job, planes->environment, &surfaces, tile->ambient, count, rgba);
    if (planes->translucent)
        add_from_behind(job, planes->environment, tile, count, rgba);
}

/* --- what another sample has found ------------------------------------------------------------ */

/* How much values in 0 … 1, and normals, may differ for two samples to count as lit alike: the mean
 * of eight samples then differs by less than a 127th anywhere in Sponza. */
static const float value_step = 1 / 64.0f;
static const float normal_step = 1 / 32.0f;

static inline float difference2(float *const a[3], float *const b[3], size_t i) {
    const float x = a[0][i] - b[0][i], y = a[1][i] - b[1][i], z = a[2][i] - b[2][i];
    return x * x + y * y + z * z;
}

static inline int are_near(const float *a, const float *b, size_t i) {
    return fabsf(a[i] - b[i]) <= value_step;
}

static inline int are_near3(float *const a[3], float *const b[3], size_t i) {
    return are_near(a[0], b[0], i) & are_near(a[1], b[1], i) & are_near(a[2], b[2], i);
}

/* Marks the pixels of a row, from `first` on, at which two samples see the same surface at nearby
 * positions; layers are not compared. The loop has no branches, and marks are no bytes, which
 * might change a pointer, so that it is vectorized. */
static TRACE_WIDE void mark_alike(const render_surfaces *a, const render_surfaces *b, size_t first,
                                  int count, int *alike) {
    const render_nearness near = render_nearness_of(&b->camera);
    const float x = b->camera.eye[0], y = b->camera.eye[1], z = b->camera.eye[2];
#pragma omp simd
    for (int k = 0; k < count; k++) {
        const size_t i = first + (size_t)k;
        const float dx = b->position[0][i] - x, dy = b->position[1][i] - y;
        const float dz = b->position[2][i] - z;
        const float allowed2 = near.constant + near.spread * (dx * dx + dy * dy + dz * dz);
        int same = a->seen[i] == b->seen[i];
        same &= difference2(a->normal, b->normal, i) <= normal_step * normal_step;
        same &= difference2(a->position, b->position, i) <= allowed2;
        same &= are_near3(a->base, b->base, i) & are_near3(a->emission, b->emission, i);
        same &= are_near(a->metallic, b->metallic, i) & are_near(a->roughness, b->roughness, i);
        same &= are_near(a->specular, b->specular, i) & are_near(a->ambient, b->ambient, i);
        alike[k] = same;
    }
}

static bool have_alike_layers(const render_surfaces *a, const render_surfaces *b, size_t i) {
    if (a->translucent && !are_near3(a->transmitted, b->transmitted, i))
        return false;
    return !a->layered || !render_material_is_layered(a->materials, a->seen[i]) ||
           (are_near(a->coat, b->coat, i) && are_near(a->coat_roughness, b->coat_roughness, i) &&
            are_near(a->sheen_roughness, b->sheen_roughness, i) &&
            are_near3(a->sheen, b->sheen, i) && are_near3(a->tint, b->tint, i) &&
            difference2(a->coat_normal, b->coat_normal, i) <= normal_step * normal_step);
}

/* --- tiles ------------------------------------------------------------------------------------ */

static void set_pixel(float *pixel, lmp_rgb color) {
    pixel[0] = color.r;
    pixel[1] = color.g;
    pixel[2] = color.b;
}

/* Lists the pixels of a row that must be shaded, by their indices; sets the others to what they
 * see. */
static size_t list_pixels(const render_surfaces *s, const shade_sample *before, int x, int y,
                          int width, uint32_t *list, float *rgba) {
    const size_t first = render_surfaces_at(s, x, y);
    int alike[RENDER_TILE] = { 0 };
    size_t others[RENDER_TILE], count = 0;
    const size_t other_count = render_surfaces_others(s, first, width, others);
    if (before)
        memcpy(rgba + 4 * first, before->rgba + 4 * first, 4 * (size_t)width * sizeof *rgba);
    if (before && other_count > 0)
        mark_alike(before->surfaces, s, first, width, alike);
    for (size_t k = 0; k < other_count; k++) {
        const size_t pixel = others[k], i = pixel - first;
        if (s->seen[pixel] >= RENDER_SEES_LIGHT)
            set_pixel(rgba + 4 * pixel, render_surfaces_beyond(s, x + (int)i, y));
        else if (!alike[i] || !have_alike_layers(before->surfaces, s, pixel))
            list[count++] = (uint32_t)pixel;
    }
    return count;
}

void shade_tile(const shade_job *job, const render_surfaces *s, const shade_sample *before,
                const render_rectangle *pixels, render_tile *tile, float *rgba) {
    uint32_t list[RENDER_TILE_PIXELS];
    float reflected[4 * RENDER_TILE_PIXELS];
    size_t count = 0;
    for (int j = 0; j < pixels->height; j++)
        count +=
            list_pixels(s, before, pixels->x, pixels->y + j, pixels->width, list + count, rgba);
    if (count == 0)
        return;
    render_surfaces_pick(s, list, count, tile);
    reflect(job, s, tile, count, reflected);
    for (size_t i = 0; i < count; i++)
        set_pixel(rgba + 4 * (size_t)list[i],
                  (lmp_rgb) { reflected[4 * i] + tile->emission[0][i],
                              reflected[4 * i + 1] + tile->emission[1][i],
                              reflected[4 * i + 2] + tile->emission[2][i] });
}

/* What all tiles of an image share. */
typedef struct tiled_image {
    const shade_job *job;
    const render_surfaces *surfaces;
    const shade_sample *before;
    float *rgba;
} tiled_image;

static void shade_visited(const render_rectangle *pixels, render_tile *tile, void *user) {
    const tiled_image *whole = user;
    if (render_next_tile(whole->job->frame))
        shade_tile(whole->job, whole->surfaces, whole->before, pixels, tile, whole->rgba);
}

bool shade_tiles(const shade_job *job, const render_surfaces *s, const shade_sample *before,
                 float *rgba) {
    tiled_image whole = { job, s, before, rgba };
    return render_tiles_visit(s->width, s->height, shade_visited, &whole);
}

/* Moves areas that the method does not sum behind the other lights. */
static void set_areas_aside(shade_job *job) {
    const size_t count = job->frame->light_count;
    job->summed = count;
    if (method_table[job->frame->method].sums_areas)
        return;
    job->summed = 0;
    for (size_t i = 0; i < count; i++)
        if (!scene_light_is_area(&job->frame->lights[i].emitter))
            job->lights[job->summed++] = job->frame->lights[i].emitter;
    for (size_t i = 0; i < count; i++)
        if (scene_light_is_area(&job->frame->lights[i].emitter))
            job->lights[job->summed + job->beside++] = job->frame->lights[i].emitter;
}

shade_job *shade_begin(const render_frame *frame, shade_want *want, void *user) {
    const bool by_field = method_table[frame->method].reads & METHOD_READS_FIELD;
    shade_job *job = calloc(1, sizeof *job);
    if (!job)
        return NULL;
    job->frame = frame;
    job->settings = (lmp_shade_settings) { .method = method_table[frame->method].method,
                                           .bands = frame->bands,
                                           .window = frame->window,
                                           .lobe = frame->lobes };
    job->lights = shade_lights(frame);
    if (job->lights)
        set_areas_aside(job);
    if (job->lights && by_field)
        job->field = shade_field_follow(frame->field, job->lights, job->summed, want, user);
    if (job->lights && (job->field || !by_field))
        return job;
    shade_end(job);
    return NULL;
}

void shade_end(shade_job *job) {
    if (!job)
        return;
    free(job->lights);
    free(job);
}

void shade_note(const shade_job *job, double milliseconds) {
    if (job->field)
        shade_field_note(job->frame->field, milliseconds);
}

bool shade_frame(const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                 base_error *error) {
    render_surfaces wanted = *surfaces;
    shade_job *job = shade_begin(frame, shade_want_surfaces, &wanted);
    const double start = timing_now();
    const bool ok = job && shade_tiles(job, surfaces, NULL, rgba);
    if (ok)
        shade_note(job, 1e3 * (timing_now() - start));
    shade_end(job);
    return ok || base_fail(error, NULL, "out of memory");
}
