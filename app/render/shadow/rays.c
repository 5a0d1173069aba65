/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/rays.h"

#include "app/render/shadow/sequence.h"
#include "app/scene/trace/wide.h"
#include "app/scene/vector.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

static bool sees_environment(const shadow_job *job) {
    return job->source_count > 0 && job->sources[job->source_count - 1].kind == SHADOW_AROUND;
}

int shadow_job_sets(const shadow_job *job) {
    return job->source_count > 1 && sees_environment(job) ? SHADOW_SETS : 1;
}

/* The sequences of a group's pixels. */
typedef struct sequence_lanes {
    uint32_t first[SHADOW_LANES], seed[SHADOW_LANES];
} sequence_lanes;

static TRACE_WIDE void set_sequences(const shadow_job *job, const shadow_group *group,
                                     sequence_lanes *sequences) {
    const uint32_t rays = (uint32_t)job->rays, seed = job->seed;
    for (int i = 0; i < SHADOW_LANES; i++) {
        const shadow_sequence one = shadow_sequence_of(group->x[i], group->y[i], rays, seed);
        sequences->first[i] = one.first;
        sequences->seed[i] = one.seed;
    }
}

/* Draws the next numbers in 0 … 1 for every pixel. */
static TRACE_WIDE void draw(const sequence_lanes *sequences, uint32_t ray, shadow_lanes *u) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const shadow_sequence one = { sequences->first[i], sequences->seed[i] };
        float numbers[3];
        shadow_draw(&one, ray, numbers);
        u[0][i] = numbers[0];
        u[1][i] = numbers[1];
        u[2][i] = numbers[2];
    }
}

/* Whether all lights are far away and so few that half of the rays find their shadows, which have
 * narrow penumbras if any. */
static bool sees_few_suns(const shadow_job *job) {
    const size_t suns = job->source_count - 1;
    bool far = 4 * suns <= (size_t)job->rays;
    for (size_t s = 0; far && s < suns; s++)
        far = job->sources[s].kind == SHADOW_FAR;
    return far && suns > 0 && sees_environment(job);
}

/* Raises the weight of the environment beside suns to that of all suns together, and thus to at
 * least half of the rays: where the suns are hidden, it is all that lights the pixel. */
static void favor_environment(const shadow_job *job, shadow_lanes *weights) {
    const size_t last = job->source_count - 1;
    for (int i = 0; i < SHADOW_LANES; i++)
        weights[last][i] = fmaxf(weights[last][i], 2 * weights[last - 1][i]);
}

/* Chooses the sources by random numbers and cumulative weights. */
static TRACE_WIDE void choose(const shadow_job *job, shadow_lanes *weights, const float *u,
                              int *chosen) {
    const size_t last = job->source_count - 1;
    for (int i = 0; i < SHADOW_LANES; i++)
        chosen[i] = 0;
    for (size_t s = 0; s < last; s++)
        for (int i = 0; i < SHADOW_LANES; i++)
            chosen[i] += weights[s][i] <= u[i] * weights[last][i];
}

/* Finds the weight with which each source was chosen, relative to the pixel's estimated light; 0
 * where no ray is to be sent. */
static void weigh_choice(const shadow_points *p, shadow_lanes *weights, const int *chosen,
                         shadow_lanes weight) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const int source = chosen[i];
        const float before = source > 0 ? weights[source - 1][i] : 0;
        weight[i] = p->lit[i] ? weights[source][i] - before : 0;
    }
}

/* Computes the contribution of each ray; rays that would contribute nothing are not sent. */
static TRACE_WIDE void value_rays(const shadow_samples *samples, const shadow_vectors *k,
                                  const float *weight, shadow_shot *shot) {
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
                const int *chosen, shadow_lanes *u, shadow_shot *shot) {
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
    memcpy(shot->source, chosen, sizeof shot->source);
    memcpy(shot->size, samples.size, sizeof shot->size);
    memcpy(shot->rays.origin, p->origin.of, sizeof shot->rays.origin);
    for (int i = 0; p->translucent && i < SHADOW_LANES; i++) {
        const lmp_vec3 from = shadow_origin(p, i, shadow_lane(&samples.direction, i));
        shot->rays.origin[0][i] = from.x;
        shot->rays.origin[1][i] = from.y;
        shot->rays.origin[2][i] = from.z;
    }
    memcpy(shot->rays.direction, samples.direction.of, sizeof shot->rays.direction);
    for (int i = 0; i < SHADOW_LANES; i++)
        if (sources[i]->kind == SHADOW_AREA && shot->rays.length[i] >= 0)
            shadow_end_at_area(shadow_lane(&p->position, i), i, &shot->rays);
}

/* Returns the reciprocal of the penumbra's width, which is at least about half a pixel. */
static float slope_of(float size, float length, float distance, float footprint) {
    const float beyond = length / (length - distance);
    return 1 / (2 * size * distance * (length <= FLT_MAX ? beyond : 1) + 0.6f * footprint);
}

/* Adds the results of those of the rays to a set of the pixels' sums that `weight` is 1 for, and
 * not 0. */
static TRACE_WIDE void add_results(const shadow_shot *shot, const shadow_lanes footprint,
                                   const shadow_lanes weight, shadow_lanes *sums) {
    for (int i = 0; i < SHADOW_LANES; i++) {
        const float length = shot->rays.length[i], mean = weight[i] * shot->mean[i];
        const bool hidden = shot->distance[i] < length;
        const float slope =
            slope_of(shot->size[i], length, hidden ? shot->distance[i] : 0, footprint[i]);
        const float r = weight[i] * shot->value.of[0][i], g = weight[i] * shot->value.of[1][i];
        const float b = weight[i] * shot->value.of[2][i];
        sums[SHADOW_ALL][i] += r;
        sums[SHADOW_ALL + 1][i] += g;
        sums[SHADOW_ALL + 2][i] += b;
        sums[SHADOW_UNHIDDEN][i] += hidden ? 0 : r;
        sums[SHADOW_UNHIDDEN + 1][i] += hidden ? 0 : g;
        sums[SHADOW_UNHIDDEN + 2][i] += hidden ? 0 : b;
        sums[SHADOW_WEIGHT][i] += mean;
        sums[SHADOW_HIDDEN][i] += hidden ? mean : 0;
        sums[SHADOW_SLOPE][i] += hidden ? mean * slope : 0;
    }
}

/* Adds the results of the rays to the pixels' sums: of those to source `around`, the environment,
 * to the last of the sets. */
static void add_shot(const shadow_shot *shot, int around, int sets, shadow_group *group) {
    shadow_lanes weight;
    for (int set = 0; set < sets; set++) {
        for (int i = 0; i < SHADOW_LANES; i++)
            weight[i] = set == (shot->source[i] == around ? sets - 1 : 0) ? 1 : 0;
        add_results(shot, group->footprint, weight, group->sums[set]);
    }
}

/* Sends the batch and begins an empty one. */
static void send_batch(const shadow_job *job, shadow_work *work) {
    work->sent += shadow_batch_send(&work->batch, job->view.bvh);
    for (int i = 0; i < work->batch.count; i++)
        add_shot(&work->batch.shots[i], work->batch.around, shadow_job_sets(job),
                 &work->groups[work->group_of[i]]);
    work->batch.count = 0;
}

/* Adds the rays of a group's points to the batch, sending it whenever it is full. */
static void add_rays(const shadow_job *job, const shadow_points *points, int number,
                     shadow_work *work) {
    const shadow_group *group = &work->groups[number];
    sequence_lanes sequences;
    shadow_sources_weigh(job->sources, job->source_count, points, work->weights);
    if (sees_few_suns(job))
        favor_environment(job, work->weights);
    set_sequences(job, group, &sequences);
    for (int ray = 0; ray < job->rays; ray++) {
        shadow_lanes u[3];
        int chosen[SHADOW_LANES];
        if (work->batch.count == SHADOW_SHOTS)
            send_batch(job, work);
        draw(&sequences, (uint32_t)ray, u);
        choose(job, work->weights, u[0], chosen);
        work->group_of[work->batch.count] = number;
        aim(job, points, work->weights, chosen, u, &work->batch.shots[work->batch.count++]);
    }
}

/* --- pixels ----------------------------------------------------------------------------------- */

/* Whether the filter would mix two pixels of a tile. */
static bool alike(const render_tile *tile, int a, int b, float footprint) {
    float off = 0, facing = 0;
    if (tile->kind[b] != RENDER_SURFACE)
        return false;
    for (int c = 0; c < 3; c++) {
        off += tile->normal[c][a] * (tile->position[c][b] - tile->position[c][a]);
        facing += tile->normal[c][a] * tile->normal[c][b];
    }
    return fabsf(off) < 0.5f * footprint && facing > 0.9f;
}

/* Whether pixel `at` sends no rays, because neighbors in its row of the tile that do are on the
 * same surface. Which pixels send rays changes from row to row and from sample to sample: one in
 * two, like a checkerboard; one in four, halfway between those of the row before. */
static bool borrows(const shadow_job *job, const render_tile *tile, const render_rectangle *pixels,
                    int at, const shadow_planes *planes) {
    const int i = at % pixels->width, x = pixels->x + i, y = pixels->y + at / pixels->width;
    const int shift = job->spacing / 2;
    const int after = (x + shift * y + job->sample) % job->spacing, before = job->spacing - after;
    const float footprint = planes->footprint[(size_t)y * (size_t)planes->width + (size_t)x];
    return after != 0 && ((i >= after && alike(tile, at, at - after, footprint)) ||
                          (i + before < pixels->width && alike(tile, at, at + before, footprint)));
}

/* Sets a row of a plane to the values of a tile's pixels, to 0 where they see no surface. */
static void store_row(const render_tile *tile, int at, const float *values, int width,
                      float *restrict plane) {
    for (int i = 0; i < width; i++)
        plane[i] = tile->kind[at + i] == RENDER_SURFACE ? values[at + i] : 0;
}

/* Initializes the planes of a tile's pixels. Pixels without a surface are 0, which gives them no
 * weight in the filter. */
static void store_tile(const shadow_job *job, const render_tile *tile,
                       const render_rectangle *pixels, shadow_planes *planes) {
    const int width = pixels->width;
    for (int j = 0; j < pixels->height; j++) {
        const size_t first = (size_t)(pixels->y + j) * (size_t)planes->width + (size_t)pixels->x;
        const int at = j * width;
        for (int k = 0; k < planes->sets * SHADOW_VALUES; k++) {
            float *values = planes->values[k / SHADOW_VALUES][k % SHADOW_VALUES];
            memset(values + first, 0, (size_t)width * sizeof *values);
        }
        for (int c = 0; c < 3; c++) {
            store_row(tile, at, tile->position[c], width, planes->position[c] + first);
            store_row(tile, at, tile->normal[c], width, planes->normal[c] + first);
        }
        for (int i = 0; i < width; i++)
            planes->footprint[first + (size_t)i] = tile->kind[at + i] == RENDER_SURFACE
                                                       ? shadow_footprint(&job->view, tile, at + i)
                                                       : 1;
    }
}

static void store_lanes(const size_t *pixels, int count, const shadow_lanes values, float *plane) {
    for (int i = 0; i < count; i++)
        plane[pixels[i]] = values[i];
}

static void store(const shadow_group *group, shadow_planes *planes) {
    size_t pixels[SHADOW_LANES];
    for (int i = 0; i < group->count; i++)
        pixels[i] = (size_t)group->y[i] * (size_t)planes->width + group->x[i];
    for (int c = 0; c < 3; c++)
        store_lanes(pixels, group->count, group->smooth.of[c], planes->normal[c]);
    for (int set = 0; set < planes->sets; set++)
        for (int k = 0; k < SHADOW_VALUES; k++)
            store_lanes(pixels, group->count, group->sums[set][k], planes->values[set][k]);
}

/* Collects the next pixels that send rays, from number `at` on, along a Morton curve so that they
 * are close to each other. Returns the number after them; `indices` receives their indices in the
 * tile. */
static uint32_t pick(const shadow_job *job, const render_tile *tile, const render_rectangle *pixels,
                     uint32_t at, const shadow_planes *planes, int indices[SHADOW_LANES],
                     shadow_group *group) {
    memset(group, 0, sizeof *group);
    for (; at < RENDER_TILE_PIXELS && group->count < SHADOW_LANES; at++) {
        const int i = (int)shadow_column(at), j = (int)shadow_column(at >> 1);
        const int index = j * pixels->width + i;
        if (i >= pixels->width || j >= pixels->height || tile->kind[index] != RENDER_SURFACE ||
            borrows(job, tile, pixels, index, planes))
            continue;
        indices[group->count] = index;
        group->x[group->count] = (uint32_t)(pixels->x + i);
        group->y[group->count++] = (uint32_t)(pixels->y + j);
    }
    return at;
}

/* Adds the rays of a group's pixels. */
static void add_group(const shadow_job *job, const render_surfaces *surfaces,
                      const int indices[SHADOW_LANES], int number, shadow_work *work) {
    shadow_group *group = &work->groups[number];
    trace_hit hits[SHADOW_LANES];
    shadow_points points;
    for (int i = 0; surfaces->hits && i < group->count; i++)
        hits[i] = surfaces->hits[render_surfaces_at(surfaces, (int)group->x[i], (int)group->y[i])];
    shadow_points_set(&job->view, &work->tile, surfaces->hits ? hits : NULL, indices, group->count,
                      &points);
    memcpy(group->footprint, points.footprint, sizeof group->footprint);
    group->smooth = points.smooth;
    add_rays(job, &points, number, work);
}

void shadow_rays_tile(const shadow_job *job, const render_surfaces *surfaces,
                      const render_rectangle *pixels, shadow_work *work, shadow_planes *planes) {
    const render_tile *tile = &work->tile;
    int indices[SHADOW_LANES];
    store_tile(job, tile, pixels, planes);
    for (uint32_t at = 0; job->source_count > 0 && at < RENDER_TILE_PIXELS;) {
        int count = 0;
        do {
            at = pick(job, tile, pixels, at, planes, indices, &work->groups[count]);
            if (work->groups[count].count > 0)
                add_group(job, surfaces, indices, count++, work);
        } while (at < RENDER_TILE_PIXELS && (count + 1) * job->rays <= SHADOW_SHOTS);
        send_batch(job, work);
        for (int i = 0; i < count; i++)
            store(&work->groups[i], planes);
    }
}

/* --- what a thread works with ----------------------------------------------------------------- */

shadow_work *shadow_work_create(const shadow_job *job) {
    const size_t count = job->source_count;
    shadow_work *work = calloc(1, sizeof *work);
    if (work)
        work->batch.around = sees_environment(job) ? (int)count - 1 : -1;
    if (work && (work->weights = malloc((count + 1) * sizeof *work->weights)) &&
        render_tile_create(RENDER_TILE_PIXELS, &work->tile))
        return work;
    shadow_work_destroy(work);
    return NULL;
}

void shadow_work_destroy(shadow_work *work) {
    if (!work)
        return;
    render_tile_free(&work->tile);
    free(work->weights);
    free(work);
}
