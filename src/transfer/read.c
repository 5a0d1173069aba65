/* SPDX-License-Identifier: MIT */
/* read.c - reads the light of surfels and probes. */
#include "src/kernels/batch.h"
#include "src/sh/layout.h"
#include "src/transfer/transfer.h"

#include <string.h>

/* The weight that the nearest surfel has at least. */
#define WEIGHT_MIN 1e-6f

static float weight_of(const lmp_transfer_surfel *surfel, lmp_vec3 point, lmp_vec3 normal) {
    const float x = point.x - surfel->position.x, y = point.y - surfel->position.y,
                z = point.z - surfel->position.z;
    const float inside = 1 - (x * x + y * y + z * z) / (surfel->radius * surfel->radius);
    const float cosine =
        normal.x * surfel->normal.x + normal.y * surfel->normal.y + normal.z * surfel->normal.z;
    return inside > 0 && cosine > 0 ? inside * inside * cosine : 0;
}

/* Adds a weighted color, and the weight as the fourth number. */
static void add(const transfer_color *color, float weight, transfer_color *sum) {
    *sum += weight * *color + (transfer_color) { 0, 0, 0, weight };
}

lmp_rgb lmp_transfer_irradiance(const lmp_transfer *transfer, size_t surfel, lmp_vec3 point,
                                lmp_vec3 normal) {
    assert(surfel < transfer->info.surfel_count && lmpi_is_finite(point) && lmpi_is_unit(normal));
    const size_t count = transfer->info.link_count;
    const uint32_t *links = transfer->links + surfel * count;
    const float own = weight_of(&transfer->surfels[surfel], point, normal);
    transfer_color sum = { 0 };
    add(&transfer->indirect[surfel], own > WEIGHT_MIN ? own : WEIGHT_MIN, &sum);
    for (size_t i = 0; i < count; i++)
        if (links[i] != LMP_TRANSFER_NONE)
            add(&transfer->indirect[links[i]],
                weight_of(&transfer->surfels[links[i]], point, normal), &sum);
    return (lmp_rgb) { sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3] };
}

void lmp_transfer_copy_irradiance_n(const lmp_transfer *transfer, size_t first, size_t count,
                                    lmp_rgb_array rgb) {
    assert(first <= transfer->info.surfel_count && count <= transfer->info.surfel_count - first);
    assert(lmpi_is_rgb_array(rgb));
    const size_t step = lmpi_batch_stride(rgb.stride, 3);
    for (size_t i = 0; i < count; i++)
        for (size_t c = 0; c < 3; c++)
            rgb.at[i * step + c] = transfer->indirect[first + i][c];
}

/* Sums what a probe's rays hit: three planes of coefficients. */
static void sum_probe(const lmp_transfer *transfer, size_t probe, float *sums) {
    const size_t row = LMP_SH_COUNT(transfer->info.bands), rays = transfer->info.probe_ray_count;
    const uint32_t *hits = transfer->probe_hits + probe * rays;
    memset(sums, 0, 3 * row * sizeof *sums);
    for (size_t k = 0; k < rays; k++) {
        const transfer_color radiosity = transfer->radiosity[hits[k]];
        const float *y = transfer->basis + k * row;
        for (size_t c = 0; c < 3; c++)
            for (size_t i = 0; i < row; i++)
                sums[c * row + i] += y[i] * radiosity[c];
    }
}

void lmp_transfer_eval_probe_n(const lmp_transfer *transfer, size_t first, size_t count,
                               lmp_sh_array sh) {
    const size_t values = 3 * LMP_SH_COUNT(transfer->info.bands);
    assert(first <= transfer->info.probe_count && count <= transfer->info.probe_count - first);
    assert(lmpi_is_sh_array(sh, values, count));
    const bool planar = sh.layout == LMP_SH_PLANAR;
    const size_t step = lmpi_batch_stride(sh.stride, planar ? count : values);
    float sums[3 * LMP_TRANSFER_BANDS_MAX * LMP_TRANSFER_BANDS_MAX];
    for (size_t i = 0; i < count; i++) {
        sum_probe(transfer, first + i, sums);
        for (size_t v = 0; v < values; v++)
            sh.at[planar ? v * step + i : i * step + v] = sums[v];
    }
}
