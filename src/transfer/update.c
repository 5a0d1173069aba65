/* SPDX-License-Identifier: MIT */
/* update.c - iterates the light between surfels. */
#include "src/transfer/transfer.h"

#include <math.h>

enum { ITERATIONS_DEFAULT = 4 };
static const float pi = 3.14159265f;

#define LIGHT_MAX 1e28f

/* Light that is fainter counts as none: it would end as subnormal numbers, which never round to 0
 * and are slow. */
#define LIGHT_MIN 1e-30f

/* --- arguments -------------------------------------------------------------------------------- */

/* Fills in the defaults; returns false if a member is outside its range. */
static bool resolve(const lmp_transfer *transfer, lmp_transfer_settings *settings) {
    if (settings->iterations == 0)
        settings->iterations = ITERATIONS_DEFAULT;
    if (settings->budget == 0 || settings->budget > transfer->info.surfel_count)
        settings->budget = transfer->info.surfel_count;
    return settings->iterations >= 1 && settings->iterations <= LMP_TRANSFER_ITERATIONS_MAX &&
           settings->remainder >= 0 && settings->remainder <= 1;
}

static bool are_colors(const lmp_rgb *colors, size_t count) {
    for (size_t i = 0; colors && i < count; i++)
        if (!(fabsf(colors[i].r) <= LIGHT_MAX && fabsf(colors[i].g) <= LIGHT_MAX &&
              fabsf(colors[i].b) <= LIGHT_MAX))
            return false;
    return true;
}

static bool is_lighting(const lmp_transfer *transfer, const lmp_transfer_lighting *lighting) {
    const size_t surfels = transfer->info.surfel_count;
    return are_colors(lighting->direct, surfels) && are_colors(lighting->emission, surfels) &&
           are_colors(lighting->sky, transfer->info.sky_count);
}

/* --- an iteration ----------------------------------------------------------------------------- */

/* Surfels first … first + count - 1, counted around the end, of which each task takes some. */
typedef struct transfer_range {
    lmp_transfer *transfer;
    const lmp_transfer_lighting *lighting;
    size_t first, count;
} transfer_range;

static size_t task_count(const transfer_range *range) {
    return (range->count + TRANSFER_TASK - 1) / TRANSFER_TASK;
}

static size_t task_end(const transfer_range *range, size_t task) {
    const size_t end = (task + 1) * TRANSFER_TASK;
    return end < range->count ? end : range->count;
}

static size_t surfel_of(const transfer_range *range, size_t i) {
    return (range->first + i) % range->transfer->info.surfel_count;
}

static lmp_rgb color_of(const lmp_rgb *colors, size_t i) {
    return colors ? colors[i] : (lmp_rgb) { 0, 0, 0 };
}

/* Computes B of a task's surfels. */
static lmp_result reflect(size_t task, void *data) {
    const transfer_range *range = data;
    const lmp_transfer *transfer = range->transfer;
    for (size_t n = task * TRANSFER_TASK; n < task_end(range, task); n++) {
        const size_t i = surfel_of(range, n);
        const lmp_rgb direct = color_of(range->lighting->direct, i);
        const lmp_rgb emission = color_of(range->lighting->emission, i);
        const lmp_rgb albedo = transfer->surfels[i].albedo;
        const transfer_color indirect = transfer->indirect[i];
        transfer->radiosity[i] =
            (transfer_color) { albedo.r * (direct.r + indirect[0]) + pi * emission.r,
                               albedo.g * (direct.g + indirect[1]) + pi * emission.g,
                               albedo.b * (direct.b + indirect[2]) + pi * emission.b };
    }
    return LMP_OK;
}

/* Computes the mean of the sources that rays hit, by four sums, because each addition waits for the
 * one before it. */
static void find_mean(const transfer_color *radiosity, const uint32_t *hits, size_t count,
                      transfer_color *mean) {
    transfer_color a = { 0 }, b = { 0 }, c = { 0 }, d = { 0 };
    size_t k = 0;
    for (; k + 4 <= count; k += 4) {
        a += radiosity[hits[k]];
        b += radiosity[hits[k + 1]];
        c += radiosity[hits[k + 2]];
        d += radiosity[hits[k + 3]];
    }
    for (; k < count; k++)
        a += radiosity[hits[k]];
    *mean = ((a + b) + (c + d)) / (float)count;
}

static float larger(float a, float b) {
    return a > b ? a : b;
}

/* Computes E of a task's surfels from B, which no task changes. */
static lmp_result gather(size_t task, void *data) {
    const transfer_range *range = data;
    const lmp_transfer *transfer = range->transfer;
    const size_t rays = transfer->info.ray_count;
    float change = 0, largest = 0;
    for (size_t n = task * TRANSFER_TASK; n < task_end(range, task); n++) {
        const size_t i = surfel_of(range, n);
        const transfer_color before = transfer->indirect[i];
        transfer_color mean;
        find_mean(transfer->radiosity, transfer->hits + i * rays, rays, &mean);
        for (int c = 0; c < 3; c++) {
            if (fabsf(mean[c]) < LIGHT_MIN)
                mean[c] = 0;
            change = larger(change, fabsf(mean[c] - before[c]));
            largest = larger(largest, fabsf(mean[c]));
        }
        transfer->indirect[i] = mean;
    }
    transfer->largest[task] = (transfer_color) { change, largest };
    return LMP_OK;
}

/* Returns how far E may be from its limit, relative to the largest E: a sequence whose steps shrink
 * by q each is within q / (1 - q) times its last step of its limit (Banach's fixed-point theorem).
 */
static float remainder_of(const transfer_range *range) {
    const float q = range->transfer->contraction;
    float change = 0, largest = 0;
    for (size_t task = 0; task < task_count(range); task++) {
        change = larger(change, range->transfer->largest[task][0]);
        largest = larger(largest, range->transfer->largest[task][1]);
    }
    if (change == 0)
        return 0;
    return q < 1 && largest > 0 ? q / (1 - q) * change / largest : INFINITY;
}

/* Performs iteration `index` of `count`. */
static lmp_result iterate(const lmp_host *host, transfer_range *range, int index, int count) {
    const double from = (double)index / count, step = 1.0 / count;
    lmp_transfer *transfer = range->transfer;
    lmp_result result =
        lmpi_host_run(host, from, from + 0.9 * step, task_count(range), gather, range);
    if (result == LMP_OK)
        result = lmpi_host_run(host, from + 0.9 * step, fmin(from + step, 1), task_count(range),
                               reflect, range);
    if (result != LMP_OK)
        return result;
    transfer->info.iterations++;
    transfer->info.remainder =
        range->count == transfer->info.surfel_count ? remainder_of(range) : INFINITY;
    range->first = transfer->next = surfel_of(range, range->count);
    return LMP_OK;
}

/* --- an update -------------------------------------------------------------------------------- */

/* Begins with the light of this frame and the last update's E. */
static lmp_result begin(const lmp_host *host, lmp_transfer *transfer,
                        const lmp_transfer_lighting *lighting) {
    transfer_range all = { transfer, lighting, 0, transfer->info.surfel_count };
    transfer_color *sky = transfer->radiosity + transfer->info.surfel_count;
    for (size_t i = 0; i < transfer->info.sky_count; i++) {
        const lmp_rgb radiance = color_of(lighting->sky, i);
        sky[i] = (transfer_color) { pi * radiance.r, pi * radiance.g, pi * radiance.b };
    }
    transfer->info.iterations = 0;
    transfer->info.remainder = INFINITY;
    return lmpi_host_run(host, 0, 0, task_count(&all), reflect, &all);
}

lmp_result lmp_transfer_update(const lmp_host *host, lmp_transfer *transfer,
                               const lmp_transfer_settings *settings,
                               const lmp_transfer_lighting *lighting) {
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_transfer_settings how = settings ? *settings : (lmp_transfer_settings) { 0 };
    if (!resolve(transfer, &how) || !is_lighting(transfer, lighting))
        return LMP_ERROR_ARGUMENT;
    transfer_range range = { transfer, lighting, transfer->next, how.budget };
    lmp_result result = begin(&resolved, transfer, lighting);
    for (int i = 0; i < how.iterations && result == LMP_OK; i++) {
        result = iterate(&resolved, &range, i, how.iterations);
        if (how.remainder > 0 && transfer->info.remainder <= how.remainder)
            break;
    }
    if (result == LMP_OK)
        resolved.progress(1, resolved.user);
    return result;
}
