/* SPDX-License-Identifier: MIT */
#include "app/render/shade/shade.h"
#include "app/render/shade/field.h"
#include "app/render/shade/lights.h"
#include "app/timing/timing.h"

#include <math.h>
#include <stdlib.h>

struct shade_job {
    const render_frame *frame;
    lmp_shade_settings settings;
    lmp_light *lights;
    const lmp_field *field; /* of these lights, or NULL */
    double start;
};

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
static void add_environment(const shade_job *job, const environment *around,
                            const lmp_surfaces *all, const float *ambient, size_t count,
                            float *rgba) {
    const lmp_environment light = { around->sh, around->bands };
    for (size_t first = 0; first < count; first += RUN) {
        const size_t some = count - first < RUN ? count - first : RUN;
        lmp_surfaces run = {
            .normal = from(&all->normal, first),
            .view = from(&all->view, first),
            .material = all->material + first,
            .material_stride = all->material_stride,
        };
        if (all->coat_normal.x)
            run.coat_normal = from(&all->coat_normal, first);
        lmp_rgb reflected[RUN];
        lmp_shade_environment_n(&job->settings, &run, some, &light, 0, &reflected->r);
        for (size_t i = 0; i < some; i++) {
            float *pixel = rgba + 4 * (first + i);
            pixel[0] += reflected[i].r * ambient[first + i];
            pixel[1] += reflected[i].g * ambient[first + i];
            pixel[2] += reflected[i].b * ambient[first + i];
        }
    }
}

/* Surfaces side by side, from `first` on; rgba receives what they reflect. */
static void reflect(const shade_job *job, const render_surfaces *planes, const render_tile *tile,
                    size_t count, float *rgba) {
    lmp_surfaces surfaces = {
        .position = vectors(tile->position, 0),
        .normal = vectors(tile->normal, 0),
        .view = vectors(tile->view, 0),
        .material = tile->material,
        .material_stride = sizeof *tile->material,
    };
    if (planes->layered)
        surfaces.coat_normal = vectors(tile->coat_normal, 0);
    if (job->field)
        lmp_field_shade_n(&job->settings, job->field, &surfaces, count, 4 * sizeof(float), rgba);
    else
        lmp_shade_n(&job->settings, &surfaces, count, job->lights, job->frame->light_count,
                    4 * sizeof(float), rgba);
    if (environment_shines(planes->environment))
        add_environment(job, planes->environment, &surfaces, tile->ambient, count, rgba);
}

/* --- what another sample has found ------------------------------------------------------------ */

/* How much values of 0 … 1 may differ, and normals, and positions in widths of a pixel, for what is
 * lit to count as lit alike. */
static const float value_step = 1 / 256.0f, normal_step = 1 / 64.0f, pixel_steps = 4;

static float distance2(float *const a[3], float *const b[3], size_t pixel) {
    float sum = 0;
    for (int c = 0; c < 3; c++) {
        const float d = a[c][pixel] - b[c][pixel];
        sum += d * d;
    }
    return sum;
}

static bool are_near(float a, float b, float step) {
    return fabsf(a - b) <= step;
}

static bool are_near3(float *const a[3], float *const b[3], size_t pixel, float step) {
    return are_near(a[0][pixel], b[0][pixel], step) && are_near(a[1][pixel], b[1][pixel], step) &&
           are_near(a[2][pixel], b[2][pixel], step);
}

/* The width of a pixel there, squared. */
static float width2_at(const render_surfaces *s, size_t pixel) {
    const render_camera *c = &s->camera;
    float down2 = 0, far2 = 0;
    for (int i = 0; i < 3; i++) {
        const float d = s->position[i][pixel] - c->eye[i];
        down2 += c->down[i] * c->down[i];
        far2 += d * d;
    }
    return 4 * down2 * (c->parallel ? 1 : far2) / ((float)c->height * (float)c->height);
}

static bool have_alike_layers(const render_surfaces *a, const render_surfaces *b, size_t i) {
    return are_near(a->coat[i], b->coat[i], value_step) &&
           are_near(a->coat_roughness[i], b->coat_roughness[i], value_step) &&
           are_near(a->sheen_roughness[i], b->sheen_roughness[i], value_step) &&
           are_near3(a->sheen, b->sheen, i, value_step) &&
           are_near3(a->tint, b->tint, i, value_step) &&
           distance2(a->coat_normal, b->coat_normal, i) <= normal_step * normal_step;
}

/* Whether two samples of a pixel see one surface, nearby. */
static bool see_alike(const render_surfaces *a, const render_surfaces *b, size_t i) {
    return a->seen[i] == b->seen[i] &&
           distance2(a->normal, b->normal, i) <= normal_step * normal_step &&
           distance2(a->position, b->position, i) <= pixel_steps * pixel_steps * width2_at(b, i) &&
           are_near3(a->base, b->base, i, value_step) &&
           are_near3(a->emission, b->emission, i, value_step) &&
           are_near(a->metallic[i], b->metallic[i], value_step) &&
           are_near(a->roughness[i], b->roughness[i], value_step) &&
           are_near(a->specular[i], b->specular[i], value_step) &&
           are_near(a->ambient[i], b->ambient[i], value_step) &&
           (!a->layered || !render_material_is_layered(a->materials, a->seen[i]) ||
            have_alike_layers(a, b, i));
}

/* --- tiles ------------------------------------------------------------------------------------ */

static void set_pixel(float *pixel, lmp_rgb color) {
    pixel[0] = color.r;
    pixel[1] = color.g;
    pixel[2] = color.b;
}

/* Lists the pixels that are to be shaded, by their indices; the others receive what they show. */
static size_t list_pixels(const render_surfaces *s, const shade_sample *before, int x, int y,
                          int width, int height, uint32_t *list, float *rgba) {
    size_t count = 0;
    for (int j = y; j < y + height; j++)
        for (int i = x; i < x + width; i++) {
            const size_t pixel = render_surfaces_at(s, i, j);
            float *const to = rgba + 4 * pixel;
            if (s->seen[pixel] >= RENDER_SEES_LIGHT)
                set_pixel(to, render_surfaces_beyond(s, i, j));
            else if (before && see_alike(before->surfaces, s, pixel))
                set_pixel(to, (lmp_rgb) { before->rgba[4 * pixel], before->rgba[4 * pixel + 1],
                                          before->rgba[4 * pixel + 2] });
            else
                list[count++] = (uint32_t)pixel;
        }
    return count;
}

void shade_tile(const shade_job *job, const render_surfaces *s, const shade_sample *before, int x,
                int y, int width, int height, render_tile *tile, float *rgba) {
    uint32_t list[SHADE_TILE * SHADE_TILE];
    float reflected[4 * SHADE_TILE * SHADE_TILE];
    const size_t count = list_pixels(s, before, x, y, width, height, list, rgba);
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

static int tiles_of(int pixels) {
    return (pixels + SHADE_TILE - 1) / SHADE_TILE;
}

static int least(int a, int b) {
    return a < b ? a : b;
}

bool shade_tiles(const shade_job *job, const render_surfaces *s, const shade_sample *before,
                 float *rgba) {
    const int columns = tiles_of(s->width), rows = tiles_of(s->height);
    bool ok = true;
#pragma omp parallel reduction(&& : ok)
    {
        render_tile tile;
        const bool mine = ok = render_tile_create(SHADE_TILE * SHADE_TILE, &tile);
#pragma omp for schedule(dynamic)
        for (int i = 0; i < columns * rows; i++)
            if (mine) {
                const int x = i % columns * SHADE_TILE, y = i / columns * SHADE_TILE;
                shade_tile(job, s, before, s->x + x, s->y + y, least(SHADE_TILE, s->width - x),
                           least(SHADE_TILE, s->height - y), &tile, rgba);
            }
        if (mine)
            render_tile_free(&tile);
    }
    return ok;
}

shade_job *shade_begin(const render_frame *frame, const render_surfaces *surfaces) {
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
    if (job->lights && by_field)
        job->field = shade_field_follow(frame->field, job->lights, frame->light_count, surfaces);
    job->start = timing_now();
    if (job->lights && (job->field || !by_field))
        return job;
    shade_end(job);
    return NULL;
}

void shade_end(shade_job *job) {
    if (!job)
        return;
    if (job->field)
        shade_field_note(job->frame->field, 1e3 * (timing_now() - job->start));
    free(job->lights);
    free(job);
}

bool shade_frame(const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                 cli_error *error) {
    shade_job *job = shade_begin(frame, surfaces);
    const bool ok = job && shade_tiles(job, surfaces, NULL, rgba);
    shade_end(job);
    return ok || cli_fail(error, NULL, "out of memory");
}
