/* SPDX-License-Identifier: MIT */
/* create.c - checks what rays have found, and copies it. */
#include "src/transfer/transfer.h"

#include <string.h>

enum { BANDS_DEFAULT = 3 };

/* --- what is acceptable ----------------------------------------------------------------------- */

static bool is_fraction(float x) {
    return x >= 0 && x <= 1;
}

static bool is_surfel(const lmp_transfer_surfel *surfel) {
    return lmpi_is_finite(surfel->position) && lmpi_is_unit(surfel->normal) &&
           is_fraction(surfel->albedo.r) && is_fraction(surfel->albedo.g) &&
           is_fraction(surfel->albedo.b) && surfel->radius > 0 && isfinite(surfel->radius);
}

static bool are_surfels(const lmp_transfer_surfel *surfels, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (!is_surfel(&surfels[i]))
            return false;
    return true;
}

/* Whether all indices exist, or are LMP_TRANSFER_NONE. */
static bool are_indices(const uint32_t *indices, size_t count, size_t end) {
    for (size_t i = 0; i < count; i++)
        if (indices[i] >= end && indices[i] != LMP_TRANSFER_NONE)
            return false;
    return true;
}

static bool are_counts(const lmp_transfer_desc *desc) {
    return desc->surfel_count >= 1 && desc->surfel_count <= LMP_TRANSFER_SOURCES_MAX &&
           desc->sky_count <= LMP_TRANSFER_SOURCES_MAX - desc->surfel_count &&
           desc->ray_count >= 1 && desc->ray_count <= LMP_TRANSFER_RAYS_MAX &&
           desc->link_count <= LMP_TRANSFER_LINKS_MAX &&
           desc->probe_count <= LMP_TRANSFER_PROBES_MAX &&
           desc->probe_ray_count <= LMP_TRANSFER_RAYS_MAX &&
           (desc->probe_count == 0 || desc->probe_ray_count >= 1) && desc->bands >= 1 &&
           desc->bands <= LMP_TRANSFER_BANDS_MAX;
}

/* Whether the arrays are there that the counts call for. */
static bool are_given(const lmp_transfer_desc *desc) {
    return desc->surfels && desc->hits && (desc->links || desc->link_count == 0) &&
           (desc->probe_count == 0 || (desc->probe_hits && desc->probe_directions));
}

/* The number of probe rays, and of their directions, as far as there are probes. */
static size_t direction_count(const lmp_transfer_desc *desc) {
    return desc->probe_count > 0 ? desc->probe_ray_count : 0;
}

static bool is_desc(const lmp_transfer_desc *desc) {
    const size_t sources = desc->surfel_count + desc->sky_count;
    return are_counts(desc) && are_given(desc) && are_surfels(desc->surfels, desc->surfel_count) &&
           are_indices(desc->hits, desc->surfel_count * desc->ray_count, sources) &&
           are_indices(desc->links, desc->surfel_count * desc->link_count, desc->surfel_count) &&
           lmpi_are_unit(lmp_vec3_array_of(desc->probe_directions), direction_count(desc)) &&
           are_indices(desc->probe_hits, desc->probe_count * desc->probe_ray_count, sources);
}

/* --- memory ----------------------------------------------------------------------------------- */

enum { LINE = 64 }; /* bytes of a cache line */

/* Takes a piece of one allocation, rounded up to whole lines; only counts where memory is NULL. The
 * count is of 64 bits, because sizes on 32-bit machines may exceed a size_t. */
static void *take(unsigned char *memory, uint64_t *used, uint64_t count, size_t size) {
    const uint64_t at = *used;
    *used += (count * size + LINE - 1) / LINE * LINE;
    return memory ? memory + at : NULL;
}

/* Lays a transfer out in memory, or only counts the bytes where memory is NULL. */
static uint64_t lay_out(lmp_transfer *transfer, unsigned char *memory) {
    const lmp_transfer_info *info = &transfer->info;
    const uint64_t surfels = info->surfel_count, sources = surfels + info->sky_count;
    const uint64_t tasks = (surfels + TRANSFER_TASK - 1) / TRANSFER_TASK;
    const size_t row = LMP_SH_COUNT(info->bands);
    uint64_t used = sizeof *transfer;
    used += LINE - ((uintptr_t)memory + used) % LINE;
    transfer->indirect = take(memory, &used, surfels, sizeof *transfer->indirect);
    transfer->radiosity = take(memory, &used, sources + 1, sizeof *transfer->radiosity);
    transfer->largest = take(memory, &used, tasks, sizeof *transfer->largest);
    transfer->surfels = take(memory, &used, surfels, sizeof *transfer->surfels);
    transfer->basis = take(memory, &used, info->probe_ray_count * row, sizeof *transfer->basis);
    transfer->hits = take(memory, &used, surfels * info->ray_count, sizeof *transfer->hits);
    transfer->links = take(memory, &used, surfels * info->link_count, sizeof *transfer->links);
    transfer->probe_hits = take(memory, &used, (uint64_t)info->probe_count * info->probe_ray_count,
                                sizeof *transfer->probe_hits);
    return used;
}

/* --- contents --------------------------------------------------------------------------------- */

static void copy_hits(const uint32_t *hits, size_t count, uint32_t none, uint32_t *copied) {
    for (size_t i = 0; i < count; i++)
        copied[i] = hits[i] == LMP_TRANSFER_NONE ? none : hits[i];
}

/* Copies an array that may be NULL if it is empty. */
static void copy(void *to, const void *from, size_t size) {
    if (size > 0)
        memcpy(to, from, size);
}

/* Fills the rows of the directions: c_lm = 4 pi / K Σ L Y_lm, and L = B / pi. */
static void fill_basis(const lmp_vec3 *directions, lmp_transfer *transfer) {
    const size_t row = LMP_SH_COUNT(transfer->info.bands);
    const size_t rays = transfer->info.probe_ray_count;
    for (size_t k = 0; k < rays; k++) {
        float *y = transfer->basis + k * row;
        lmp_sh_eval(transfer->info.bands, directions[k], y);
        for (size_t i = 0; i < row; i++)
            y[i] *= 4 / (float)rays;
    }
}

/* Returns the maximum norm of the iteration's matrix, whose row i holds, at each surfel, its albedo
 * times the fraction of rays from i that hit it. */
static float contraction_of(const lmp_transfer *transfer) {
    const size_t rays = transfer->info.ray_count;
    float largest = 0;
    for (size_t i = 0; i < transfer->info.surfel_count; i++) {
        float sum[3] = { 0 };
        for (size_t k = 0; k < rays; k++) {
            const uint32_t hit = transfer->hits[i * rays + k];
            if (hit >= transfer->info.surfel_count)
                continue;
            const lmp_rgb albedo = transfer->surfels[hit].albedo;
            sum[0] += albedo.r;
            sum[1] += albedo.g;
            sum[2] += albedo.b;
        }
        largest = fmaxf(largest, fmaxf(sum[0], fmaxf(sum[1], sum[2])) / (float)rays);
    }
    return largest;
}

void lmp_transfer_reset(lmp_transfer *transfer) {
    lmp_transfer_info *info = &transfer->info;
    const size_t sources = info->surfel_count + info->sky_count;
    memset(transfer->indirect, 0, info->surfel_count * sizeof *transfer->indirect);
    memset(transfer->radiosity, 0, (sources + 1) * sizeof *transfer->radiosity);
    transfer->next = 0;
    info->iterations = 0;
    info->remainder = INFINITY;
}

static void fill(const lmp_transfer_desc *desc, lmp_transfer *transfer) {
    const lmp_transfer_info *info = &transfer->info;
    const size_t sources = info->surfel_count + info->sky_count;
    copy(transfer->surfels, desc->surfels, info->surfel_count * sizeof *desc->surfels);
    copy(transfer->links, desc->links, info->surfel_count * info->link_count * sizeof *desc->links);
    copy_hits(desc->hits, info->surfel_count * info->ray_count, (uint32_t)sources, transfer->hits);
    copy_hits(desc->probe_hits, info->probe_count * info->probe_ray_count, (uint32_t)sources,
              transfer->probe_hits);
    fill_basis(desc->probe_directions, transfer);
    transfer->contraction = contraction_of(transfer);
    lmp_transfer_reset(transfer);
}

lmp_result lmp_transfer_create(const lmp_host *host, const lmp_transfer_desc *desc,
                               lmp_transfer **transfer) {
    lmp_transfer_desc resolved = desc ? *desc : (lmp_transfer_desc) { 0 };
    *transfer = NULL;
    if (resolved.bands == 0)
        resolved.bands = BANDS_DEFAULT;
    if (!is_desc(&resolved))
        return LMP_ERROR_ARGUMENT;
    lmp_transfer plan = { .host = lmpi_host_resolve(host),
                          .info = { .surfel_count = resolved.surfel_count,
                                    .sky_count = resolved.sky_count,
                                    .ray_count = resolved.ray_count,
                                    .link_count = resolved.link_count,
                                    .probe_count = resolved.probe_count,
                                    .probe_ray_count = direction_count(&resolved),
                                    .bands = resolved.bands } };
    const uint64_t bytes = lay_out(&plan, NULL) + LINE;
    if (bytes > SIZE_MAX)
        return LMP_ERROR_MEMORY;
    plan.info.bytes = (size_t)bytes;
    unsigned char *memory = lmpi_allocate(&plan.host, plan.info.bytes);
    if (!memory)
        return LMP_ERROR_MEMORY;
    lay_out(&plan, memory);
    fill(&resolved, &plan);
    *transfer = (lmp_transfer *)(void *)memory;
    **transfer = plan;
    return LMP_OK;
}

void lmp_transfer_destroy(lmp_transfer *transfer) {
    lmpi_release_object(transfer);
}

lmp_transfer_info lmp_transfer_describe(const lmp_transfer *transfer) {
    return transfer->info;
}
