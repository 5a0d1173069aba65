/* SPDX-License-Identifier: MIT */
/* brdf_make.c - makes a preintegrated BRDF: its series, the rows of its slices, the views and half
 * angles to hold, then the slices of each half angle. */
#include "src/base/host.h"
#include "src/preintegrated/brdf_nodes.h"
#include "src/preintegrated/brdf_rows.h"
#include "src/preintegrated/brdf_slices.h"

#include <stdatomic.h>
#include <string.h>

typedef struct making {
    const lmp_preintegrated_brdf_desc *desc;
    const brdf_series *series;
    brdf_views views;
    int caps[BRDF_STEPS_MAX + 1], view_nodes[BRDF_STEPS_MAX + 1];
    int cap_count, view_count;
    brdf_column columns[BRDF_STEPS_MAX + 1];
    atomic_size_t texels;
} making;

static size_t texels_max(const lmp_preintegrated_brdf_desc *desc) {
    return desc->bytes_max / (3 * sizeof(int16_t));
}

static lmp_result slices_task(size_t index, void *data) {
    making *job = data;
    brdf_column *column = &job->columns[index];
    const lmp_result result = lmpi_preintegrated_brdf_slices(&job->views, job->caps, job->cap_count,
                                                             (int)index, job->desc->error, column);
    if (result != LMP_OK)
        return result;
    const size_t texels = atomic_fetch_add(&job->texels, column->texel_count) + column->texel_count;
    return texels <= texels_max(job->desc) ? LMP_OK : LMP_ERROR_MEMORY;
}

/* Fills in the slice coordinate at every step, given the steps of the slices. */
static void fill_remap(const int *nodes, int count, float *remap) {
    for (int k = 0; k + 1 < count; k++)
        for (int i = nodes[k]; i <= nodes[k + 1]; i++)
            remap[i] = (float)k + (float)(i - nodes[k]) / (float)(nodes[k + 1] - nodes[k]);
}

/* Assembles the slices of all columns, view by view, into one object. */
static lmp_result assemble(const lmp_host *host, const making *job,
                           lmp_preintegrated_brdf_info info, lmp_preintegrated_brdf **brdf) {
    const size_t caps = (size_t)job->cap_count;
    for (size_t i = 0; i < caps; i++)
        info.texel_count += job->columns[i].texel_count;
    info.view_count = (uint32_t)job->view_count;
    info.cap_count = (uint32_t)job->cap_count;
    info.view_steps = (uint32_t)job->series->steps;
    info.cap_steps = BRDF_CAP_STEPS;
    const lmp_result result = lmpi_preintegrated_brdf_allocate(host, &info, brdf);
    if (result != LMP_OK)
        return result;
    int view_steps[BRDF_STEPS_MAX + 1] = { 0 };
    for (int i = 0; i < job->view_count; i++)
        view_steps[i] = job->series->step[job->view_nodes[i]];
    fill_remap(view_steps, job->view_count, (*brdf)->view_remap);
    fill_remap(job->caps, job->cap_count, (*brdf)->cap_remap);
    uint32_t first = 0;
    for (size_t v = 0; v < (size_t)job->view_count; v++) {
        (*brdf)->ambient[v] = job->series->ambient[job->view_nodes[v]];
        for (size_t i = 0; i < caps; i++) {
            lmp_preintegrated_brdf_slice *slice = &(*brdf)->slices[v * caps + i];
            *slice = job->columns[i].slices[v];
            const size_t texels = (size_t)slice->rows * slice->columns;
            memcpy((*brdf)->texels + 3 * (size_t)first,
                   job->columns[i].texels + 3 * (size_t)slice->first, texels * 3 * sizeof(int16_t));
            slice->first = first;
            first += (uint32_t)texels;
        }
    }
    return LMP_OK;
}

static lmp_result make_slices(const lmp_host *host, making *job,
                              const lmp_preintegrated_brdf_info *info,
                              lmp_preintegrated_brdf **brdf) {
    lmp_result result = lmpi_host_run(&job->series->host, BRDF_NODES_DONE, 1,
                                      (size_t)job->cap_count, slices_task, job);
    if (result == LMP_OK)
        result = assemble(host, job, *info, brdf);
    for (int i = 0; i < job->cap_count; i++)
        lmpi_preintegrated_brdf_column_free(job->series, &job->columns[i]);
    return result;
}

static lmp_result make(const lmp_host *host, making *job, const lmp_preintegrated_brdf_info *info,
                       lmp_preintegrated_brdf **brdf) {
    lmp_result result =
        lmpi_preintegrated_brdf_caps(job->series, job->desc->error, job->caps, &job->cap_count);
    if (result == LMP_OK)
        result = lmpi_preintegrated_brdf_view_nodes(job->series, job->desc->error, job->view_nodes,
                                                    &job->view_count);
    if (result == LMP_OK)
        result = lmpi_preintegrated_brdf_views(job->series, job->view_nodes,
                                               (size_t)job->view_count, 0, &job->views);
    if (result != LMP_OK)
        return result;
    result = make_slices(host, job, info, brdf);
    lmpi_preintegrated_brdf_views_free(&job->views);
    return result;
}

/* Fills in the defaults; returns whether all members are in their ranges. */
static bool resolve_desc(const lmp_brdf_table *table, lmp_preintegrated_brdf_desc *desc) {
    desc->error = desc->error == 0 ? LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT : desc->error;
    desc->bytes_max = desc->bytes_max ? desc->bytes_max : LMP_PREINTEGRATED_BRDF_BYTES_MAX;
    return desc->error >= LMP_PREINTEGRATED_LOBE_ERROR_MIN && desc->error <= 0.1f &&
           lmp_brdf_table_describe(table).azimuths == 1;
}

/* Makes a preintegrated BRDF from its series. */
static lmp_result make_from_series(const lmp_host *host, const lmp_brdf_table_info *table,
                                   const lmp_preintegrated_brdf_desc *desc, brdf_series *series,
                                   making *job, lmp_preintegrated_brdf **brdf) {
    const lmp_result result = lmpi_preintegrated_brdf_choose_rows(series, desc->error);
    if (result != LMP_OK)
        return result;
    memset(job, 0, sizeof *job);
    job->desc = desc;
    job->series = series;
    const lmp_preintegrated_brdf_info info = { .bands = table->bands,
                                               .window = table->window,
                                               .window_size = table->window_size,
                                               .error = desc->error,
                                               .mirrored = table->mirrored,
                                               .width = series->width,
                                               .radius = series->radius,
                                               .reach = series->reach,
                                               .slope = series->slope,
                                               .lobe_angle = series->lobe_angle };
    return make(host, job, &info, brdf);
}

lmp_result lmp_preintegrated_brdf_create(const lmp_host *host,
                                         const lmp_preintegrated_brdf_desc *desc,
                                         const lmp_brdf_table *table,
                                         lmp_preintegrated_brdf **brdf) {
    *brdf = NULL;
    lmp_preintegrated_brdf_desc own = { 0 };
    if (desc)
        own = *desc;
    if (!resolve_desc(table, &own))
        return LMP_ERROR_ARGUMENT;
    const lmp_host resolved = lmpi_host_resolve(host);
    brdf_series *series = lmpi_allocate(&resolved, sizeof *series);
    making *job = lmpi_allocate(&resolved, sizeof *job);
    lmp_result result = series && job
                            ? lmpi_preintegrated_brdf_series(&resolved, own.error, table, series)
                            : LMP_ERROR_MEMORY;
    if (result == LMP_OK) {
        const lmp_brdf_table_info info = lmp_brdf_table_describe(table);
        result = make_from_series(host, &info, &own, series, job, brdf);
        lmpi_preintegrated_brdf_series_free(series);
    }
    lmpi_release(&resolved, job);
    lmpi_release(&resolved, series);
    return result;
}
