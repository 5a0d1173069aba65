/* SPDX-License-Identifier: MIT */
#include "app/shadow/rays.h"

#include "app/scene/vector.h"
#include "app/shadow/sequence.h"
#include "app/shadow/wide.h"

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
    return (rgb.r + rgb.g + rgb.b) / 3;
}

/* The sources' weights, each with those before it, from lane to lane. */
static void accumulate_weights(const shadow_job *job, const shadow_points *points, float *weights) {
    shadow_lanes sum = { 0 }, weight;
    for (size_t s = 0; s < job->source_count; s++) {
        shadow_source_weigh(&job->sources[s], points, weight);
        for (int i = 0; i < SHADOW_LANES; i++) {
            sum[i] += weight[i] > 0 ? weight[i] : 0;
            weights[s * SHADOW_LANES + (size_t)i] = sum[i];
        }
    }
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
static SHADOW_WIDE void choose(const shadow_job *job, const float *weights, const float *u,
                               int *chosen) {
    const float *total = weights + (job->source_count - 1) * SHADOW_LANES;
    for (int i = 0; i < SHADOW_LANES; i++)
        chosen[i] = 0;
    for (const float *sum = weights; sum < total; sum += SHADOW_LANES)
        for (int i = 0; i < SHADOW_LANES; i++)
            chosen[i] += sum[i] <= u[i] * total[i];
}

static void aim(const shadow_job *job, const shadow_points *p, const float *weights, int source,
                shadow_lanes *u, int i, ray_shot *shot) {
    const float *sum = weights + source * SHADOW_LANES + i;
    const float weight = source > 0 ? sum[0] - sum[-SHADOW_LANES] : sum[0];
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
    if (!(mean_of(value) > 0) || !isfinite(mean_of(value)))
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
        const float rgb[3] = { value.r, value.g, value.b };
        for (int c = 0; c < 3; c++) {
            sums->of[SHADOW_ALL + c][i] += rgb[c];
            sums->of[SHADOW_UNHIDDEN + c][i] += hidden ? 0 : rgb[c];
        }
        sums->of[SHADOW_WEIGHT][i] += mean_of(value);
        if (!hidden)
            continue;
        sums->of[SHADOW_HIDDEN][i] += mean_of(value);
        sums->of[SHADOW_SLOPE][i] +=
            mean_of(value) / penumbra_of(shot, i, distance, points->footprint[i]);
    }
    return count;
}

static size_t send_rays(const shadow_job *job, const shadow_points *points, int x, int y,
                        float *weights, shadow_sums *sums) {
    shadow_sequence sequences[SHADOW_LANES];
    size_t count = 0;
    accumulate_weights(job, points, weights);
    for (int i = 0; i < SHADOW_LANES; i++)
        sequences[i] =
            shadow_sequence_of((uint32_t)(x + i), (uint32_t)y, (uint32_t)job->rays, job->seed);
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

/* What is no surface is 0, and so without weight for the filter. */
static void store(const shadow_points *points, const shadow_sums *sums, size_t first, int count,
                  shadow_planes *planes) {
    for (int i = 0; i < count; i++) {
        const size_t pixel = first + (size_t)i;
        const bool lit = points->lit[i];
        for (int c = 0; c < 3; c++) {
            planes->position[c][pixel] = lit ? points->position.of[c][i] : 0;
            planes->normal[c][pixel] = lit ? points->smooth.of[c][i] : 0;
        }
        planes->footprint[pixel] = lit ? points->footprint[i] : 1;
        for (int k = 0; k < SHADOW_VALUES; k++)
            planes->values[k][pixel] = lit ? sums->of[k][i] : 0;
    }
}

size_t shadow_rays_row(const shadow_job *job, const gpu_row *row, int y, float *weights,
                       shadow_planes *planes) {
    const int width = planes->width;
    size_t sent = 0;
    for (int x = 0; x < width; x += SHADOW_LANES) {
        const int count = width - x < SHADOW_LANES ? width - x : SHADOW_LANES;
        shadow_sums sums = { { { 0 } } };
        shadow_points points;
        shadow_points_set(&job->view, row, x, width, &points);
        if (job->source_count > 0)
            sent += send_rays(job, &points, x, y, weights, &sums);
        store(&points, &sums, (size_t)y * (size_t)width + (size_t)x, count, planes);
    }
    return sent;
}
