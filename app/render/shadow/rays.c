/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/rays.h"

#include "app/render/shadow/sequence.h"
#include "app/scene/vector.h"
#include "app/trace/wide.h"

#include <float.h>
#include <string.h>

/* One ray a lane, and what it stands for. */
typedef struct ray_shot {
    trace_rays rays;
    shadow_lanes size, mean; /* of the light, as in shadow_samples; of the value's colors */
    shadow_vectors value;
} ray_shot;

/* Of the values of planes.h. */
typedef struct shadow_sums {
    shadow_lanes of[SHADOW_VALUES];
} shadow_sums;

/* The next numbers in 0 … 1 of every pixel. */
static TRACE_WIDE void draw(const shadow_sequence *sequences, uint32_t ray, shadow_lanes *u) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        float numbers[3];
        shadow_draw(&sequences[i], ray, numbers);
        for (int k = 0; k < 3; k++)
            u[k][i] = numbers[k];
    }
}

/* The sources that numbers fall on. */
static TRACE_WIDE void choose(const shadow_job *job, shadow_lanes *weights, const float *u,
                              int *chosen) {
    const size_t last = job->source_count - 1;
    for (int i = 0; i < SHADOW_LANES; i++)
        chosen[i] = 0;
    for (size_t s = 0; s < last; s++)
        for (int i = 0; i < SHADOW_LANES; i++)
            chosen[i] += weights[s][i] <= u[i] * weights[last][i];
}

/* The probability with which each was chosen, in parts of the pixel's guess of what it gets; 0
 * where nothing is to be sent. */
static void weigh_choice(const shadow_points *p, shadow_lanes *weights, const int *chosen,
                         shadow_lanes weight) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const int source = chosen[i];
        const float before = source > 0 ? weights[source - 1][i] : 0;
        weight[i] = p->lit[i] ? weights[source][i] - before : 0;
    }
}

/* What each ray brings; rays that would bring nothing are not sent. */
static TRACE_WIDE void value_rays(const shadow_samples *samples, const shadow_vectors *k,
                                  const float *weight, ray_shot *shot) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float scale = 1 / (weight[i] > 0 ? weight[i] : 1);
        const float r = samples->arrives.of[0][i] * k->of[0][i] * scale;
        const float g = samples->arrives.of[1][i] * k->of[1][i] * scale;
        const float b = samples->arrives.of[2][i] * k->of[2][i] * scale;
        const float mean = weight[i] > 0 ? (r + g + b) * (1 / 3.0f) : 0;
        const bool sent = mean > 0 && mean <= FLT_MAX;
        shot->mean[i] = sent ? mean : 0;
        shot->value.of[0][i] = sent ? r : 0;
        shot->value.of[1][i] = sent ? g : 0;
        shot->value.of[2][i] = sent ? b : 0;
        shot->rays.start[i] = 0;
        shot->rays.length[i] = sent ? samples->length[i] : -1;
    }
}

static void aim(const shadow_job *job, const shadow_points *p, shadow_lanes *weights,
                const int *chosen, shadow_lanes *u, ray_shot *shot) {
    const shadow_source *sources[SHADOW_LANES];
    shadow_samples samples;
    shadow_vectors k;
    shadow_lanes weight;
    for (int i = 0; i < SHADOW_LANES; i++)
        sources[i] = &job->sources[chosen[i]];
    shadow_sources_draw(sources, &p->position, p, u[1], u[2], &samples);
    shadow_reflect(p, &samples.direction, &k);
    weigh_choice(p, weights, chosen, weight);
    for (int i = 0; i < SHADOW_LANES; i++)
        if (sources[i]->kind == SHADOW_AROUND)
            shadow_set_lane(&samples.arrives, i,
                            vec_scale(shadow_lane(&samples.arrives, i), p->ambient[i]));
    value_rays(&samples, &k, weight, shot);
    memcpy(shot->size, samples.size, sizeof shot->size);
    memcpy(shot->rays.origin, p->origin.of, sizeof shot->rays.origin);
    memcpy(shot->rays.direction, samples.direction.of, sizeof shot->rays.direction);
}

/* Over how wide the half-shadow is of what hides a light, at least half a pixel. */
static float slope_of(float size, float length, float distance, float footprint) {
    const float beyond = length / (length - distance);
    return 1 / (2 * size * distance * (length <= FLT_MAX ? beyond : 1) + 0.6f * footprint);
}

/* Adds what the rays have found to the pixels' sums. */
static TRACE_WIDE void add_shot(const ray_shot *shot, const float *distances,
                                const shadow_points *points, shadow_sums *sums) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float length = shot->rays.length[i], mean = shot->mean[i];
        const bool hidden = distances[i] < length;
        const float slope =
            slope_of(shot->size[i], length, hidden ? distances[i] : 0, points->footprint[i]);
        for (int c = 0; c < 3; c++) {
            const float value = shot->value.of[c][i];
            sums->of[SHADOW_ALL + c][i] += value;
            sums->of[SHADOW_UNHIDDEN + c][i] += hidden ? 0 : value;
        }
        sums->of[SHADOW_WEIGHT][i] += mean;
        sums->of[SHADOW_HIDDEN][i] += hidden ? mean : 0;
        sums->of[SHADOW_SLOPE][i] += hidden ? mean * slope : 0;
    }
}

/* Sends what has a length, and returns how many those are. */
static size_t send(const shadow_job *job, const ray_shot *shot, shadow_lanes distances) {
    trace_hit hits[SHADOW_LANES];
    size_t count = 0;
    trace_nearest_n(job->view.bvh, TRACE_LIGHT, &shot->rays, hits);
    for (int i = 0; i < SHADOW_LANES; i++) {
        distances[i] = hits[i].distance;
        count += shot->rays.length[i] >= 0;
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
        shadow_lanes distances;
        ray_shot shot;
        draw(sequences, (uint32_t)ray, u);
        choose(job, weights, u[0], chosen);
        aim(job, points, weights, chosen, u, &shot);
        count += send(job, &shot, distances);
        add_shot(&shot, distances, points, sums);
    }
    return count;
}

/* --- a row ------------------------------------------------------------------------------------ */

/* Whether the filter would mix two pixels of a row. */
static bool alike(const render_tile *row, int a, int b, float footprint) {
    float off = 0, facing = 0;
    if (row->kind[b] != RENDER_SURFACE)
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
static bool borrows(const shadow_job *job, const render_tile *row, int x, int y,
                    const shadow_planes *planes) {
    const float footprint = planes->footprint[(size_t)y * (size_t)planes->width + (size_t)x];
    const int shift = job->spacing / 2;
    const int after = (x + shift * y + job->sample) % job->spacing;
    const int left = x - after, right = left + job->spacing;
    return after != 0 && ((left >= 0 && alike(row, x, left, footprint)) ||
                          (right < planes->width && alike(row, x, right, footprint)));
}

/* Pixels without rays. What is no surface is 0, and so without weight for the filter. */
static void store_row(const shadow_job *job, const render_tile *row, int y, shadow_planes *planes) {
    const size_t first = (size_t)y * (size_t)planes->width;
    for (int k = 0; k < SHADOW_VALUES; k++)
        memset(planes->values[k] + first, 0, (size_t)planes->width * sizeof *planes->values[k]);
    for (int x = 0; x < planes->width; x++) {
        const size_t pixel = first + (size_t)x;
        const bool lit = row->kind[x] == RENDER_SURFACE;
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

size_t shadow_rays_row(const shadow_job *job, const render_tile *row, int y, shadow_lanes *weights,
                       shadow_planes *planes) {
    const size_t first = (size_t)y * (size_t)planes->width;
    const trace_hit *hits = job->hits ? job->hits + first : NULL;
    size_t sent = 0;
    store_row(job, row, y, planes);
    for (int x = 0; job->source_count > 0 && x < planes->width;) {
        int pixels[SHADOW_LANES] = { 0 }, count = 0;
        for (; x < planes->width && count < SHADOW_LANES; x++)
            if (row->kind[x] == RENDER_SURFACE && !borrows(job, row, x, y, planes))
                pixels[count++] = x;
        shadow_sums sums = { { { 0 } } };
        shadow_points points;
        shadow_points_set(&job->view, row, hits, pixels, count, &points);
        sent += send_rays(job, &points, pixels, y, weights, &sums);
        store(&points, &sums, first, pixels, planes);
    }
    return sent;
}
