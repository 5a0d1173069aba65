/* SPDX-License-Identifier: MIT */
#include "app/shadow/rays.h"

#include "app/scene/vector.h"
#include "app/shadow/sequence.h"
#include "app/shadow/wide.h"

#include <string.h>

/* One ray a lane, and what it stands for. */
typedef struct ray_shot {
    trace_rays rays;
    shadow_lanes size; /* of the light, as in shadow_sample */
    lmp_rgb value[SHADOW_LANES];
} ray_shot;

/* Of the values of planes.h. */
typedef struct shadow_sums {
    shadow_lanes of[SHADOW_VALUES];
} shadow_sums;

static float mean_of(lmp_rgb rgb) {
    return (rgb.r + rgb.g + rgb.b) * (1 / 3.0f);
}

/* The next numbers in 0 … 1 of every pixel. */
static SHADOW_WIDE void draw(const shadow_sequence *sequences, uint32_t ray, shadow_lanes *u) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        float numbers[3];
        shadow_draw(&sequences[i], ray, numbers);
        for (int k = 0; k < 3; k++)
            u[k][i] = numbers[k];
    }
}

/* The sources that numbers fall on. */
static SHADOW_WIDE void choose(const shadow_job *job, shadow_lanes *weights, const float *u,
                               int *chosen) {
    const size_t last = job->source_count - 1;
    for (int i = 0; i < SHADOW_LANES; i++)
        chosen[i] = 0;
    for (size_t s = 0; s < last; s++)
        for (int i = 0; i < SHADOW_LANES; i++)
            chosen[i] += weights[s][i] <= u[i] * weights[last][i];
}

static void aim(const shadow_job *job, const shadow_points *p, shadow_lanes *weights, int source,
                shadow_lanes *u, int i, ray_shot *shot) {
    const float weight = weights[source][i] - (source > 0 ? weights[source - 1][i] : 0);
    shot->rays.length[i] = -1;
    shot->value[i] = (lmp_rgb) { 0, 0, 0 };
    if (!p->lit[i] || !(weight > 0))
        return;
    const lmp_vec3 at = { p->position.of[0][i], p->position.of[1][i], p->position.of[2][i] };
    const shadow_sample sample = shadow_source_draw(&job->sources[source], at, u[1][i], u[2][i]);
    const lmp_rgb k = shadow_reflect(p, i, sample.direction);
    const float heeded = job->sources[source].kind == SHADOW_AROUND ? p->ambient[i] : 1;
    const float scale = heeded / weight;
    const lmp_rgb value = { sample.arrives.r * k.r * scale, sample.arrives.g * k.g * scale,
                            sample.arrives.b * k.b * scale };
    const float mean = mean_of(value);
    if (!(mean > 0) || !isfinite(mean))
        return;
    shot->value[i] = value;
    shot->size[i] = sample.size;
    shot->rays.length[i] = sample.length;
    for (int c = 0; c < 3; c++)
        shot->rays.origin[c][i] = p->origin.of[c][i];
    shot->rays.direction[0][i] = sample.direction.x;
    shot->rays.direction[1][i] = sample.direction.y;
    shot->rays.direction[2][i] = sample.direction.z;
}

/* How wide the half-shadow is of what hides a light, at least half a pixel. */
static float penumbra_of(const ray_shot *shot, int i, float distance, float footprint) {
    const float length = shot->rays.length[i];
    const float beyond = isfinite(length) ? length / (length - distance) : 1;
    return 2 * shot->size[i] * distance * beyond + 0.6f * footprint;
}

/* Adds what the rays have found to the pixels' sums. */
static size_t add_shot(const ray_shot *shot, const trace_hit hits[SHADOW_LANES],
                       const shadow_points *points, shadow_sums *sums) {
    size_t count = 0;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const lmp_rgb value = shot->value[i];
        const float distance = hits[i].distance;
        if (shot->rays.length[i] < 0)
            continue;
        count++;
        const bool hidden = hits[i].mesh != TRACE_NOTHING && distance < shot->rays.length[i];
        const float rgb[3] = { value.r, value.g, value.b }, mean = mean_of(value);
        for (int c = 0; c < 3; c++) {
            sums->of[SHADOW_ALL + c][i] += rgb[c];
            sums->of[SHADOW_UNHIDDEN + c][i] += hidden ? 0 : rgb[c];
        }
        sums->of[SHADOW_WEIGHT][i] += mean;
        if (!hidden)
            continue;
        sums->of[SHADOW_HIDDEN][i] += mean;
        sums->of[SHADOW_SLOPE][i] += mean / penumbra_of(shot, i, distance, points->footprint[i]);
    }
    return count;
}

static size_t send_rays(const shadow_job *job, const shadow_points *points, const int *pixels,
                        int y, shadow_lanes *weights, shadow_sums *sums) {
    shadow_sequence sequences[SHADOW_LANES];
    size_t count = 0;
    shadow_sources_weigh(job->sources, job->source_count, points, weights);
    for (int i = 0; i < SHADOW_LANES; i++)
        sequences[i] =
            shadow_sequence_of((uint32_t)pixels[i], (uint32_t)y, (uint32_t)job->rays, job->seed);
    for (int ray = 0; ray < job->rays; ray++) {
        shadow_lanes u[3];
        int chosen[SHADOW_LANES];
        ray_shot shot;
        trace_hit hits[SHADOW_LANES];
        draw(sequences, (uint32_t)ray, u);
        choose(job, weights, u[0], chosen);
        for (int i = 0; i < SHADOW_LANES; i++)
            aim(job, points, weights, chosen[i], u, i, &shot);
        trace_nearest_n(job->view.bvh, TRACE_LIGHT, &shot.rays, hits);
        count += add_shot(&shot, hits, points, sums);
    }
    return count;
}

/* --- a row ------------------------------------------------------------------------------------ */

/* Whether the filter would mix two pixels of a row. */
static bool alike(const gpu_row *row, int a, int b, float footprint) {
    float off = 0, facing = 0;
    if (row->kind[b] != GPU_KIND_SURFACE)
        return false;
    for (int c = 0; c < 3; c++) {
        off += row->normal[c][a] * (row->position[c][b] - row->position[c][a]);
        facing += row->normal[c][a] * row->normal[c][b];
    }
    return fabsf(off) < 0.5f * footprint && facing > 0.9f;
}

/* Whether it takes what the pixels find that send rays, which are others in the next row and in the
 * next sample: of two, as the colors of a checkerboard; of four, in every row between those of the
 * row before. */
static bool borrows(const shadow_job *job, const gpu_row *row, int x, int y,
                    const shadow_planes *planes) {
    const float footprint = planes->footprint[(size_t)y * (size_t)planes->width + (size_t)x];
    const int shift = job->spacing / 2;
    const int after = (x + shift * y + job->sample) % job->spacing;
    const int left = x - after, right = left + job->spacing;
    return after != 0 && ((left >= 0 && alike(row, x, left, footprint)) ||
                          (right < planes->width && alike(row, x, right, footprint)));
}

/* Pixels without rays. What is no surface is 0, and so without weight for the filter. */
static void store_row(const shadow_job *job, const gpu_row *row, int y, shadow_planes *planes) {
    const size_t first = (size_t)y * (size_t)planes->width;
    for (int k = 0; k < SHADOW_VALUES; k++)
        memset(planes->values[k] + first, 0, (size_t)planes->width * sizeof *planes->values[k]);
    for (int x = 0; x < planes->width; x++) {
        const size_t pixel = first + (size_t)x;
        const bool lit = row->kind[x] == GPU_KIND_SURFACE;
        for (int c = 0; c < 3; c++) {
            planes->position[c][pixel] = lit ? row->position[c][x] : 0;
            planes->normal[c][pixel] = lit ? row->normal[c][x] : 0;
        }
        planes->footprint[pixel] = lit ? shadow_footprint(&job->view, row, x) : 1;
    }
}

static void store(const shadow_points *points, const shadow_sums *sums, size_t first,
                  const int *pixels, shadow_planes *planes) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const size_t pixel = first + (size_t)pixels[i];
        if (!points->lit[i])
            continue;
        for (int c = 0; c < 3; c++)
            planes->normal[c][pixel] = points->smooth.of[c][i];
        for (int k = 0; k < SHADOW_VALUES; k++)
            planes->values[k][pixel] = sums->of[k][i];
    }
}

size_t shadow_rays_row(const shadow_job *job, const gpu_row *row, int y, shadow_lanes *weights,
                       shadow_planes *planes) {
    const size_t first = (size_t)y * (size_t)planes->width;
    size_t sent = 0;
    store_row(job, row, y, planes);
    for (int x = 0; job->source_count > 0 && x < planes->width;) {
        int pixels[SHADOW_LANES] = { 0 }, count = 0;
        for (; x < planes->width && count < SHADOW_LANES; x++)
            if (row->kind[x] == GPU_KIND_SURFACE && !borrows(job, row, x, y, planes))
                pixels[count++] = x;
        shadow_sums sums = { { { 0 } } };
        shadow_points points;
        shadow_points_set(&job->view, row, pixels, count, &points);
        sent += send_rays(job, &points, pixels, y, weights, &sums);
        store(&points, &sums, first, pixels, planes);
    }
    return sent;
}
