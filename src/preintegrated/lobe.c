/* SPDX-License-Identifier: MIT */
#include "src/preintegrated/lobe.h"

#include "src/base/allocator.h"
#include "src/base/parallel.h"

#include <stdatomic.h>
#include <string.h>

#define BANDS_DEFAULT 10

/* What the tasks of a creation share. */
typedef struct creation {
    lmp_preintegrated_lobe *response;
    const lmp_preintegrated_lobe_desc *desc;
    atomic_uint done;
    atomic_int failed;
} creation;

static void fill_task(size_t index, void *data) {
    creation *job = data;
    const size_t tasks = 2 * (size_t)job->response->info.cell_count;
    if (lmp_preintegrated_lobe_fill(job->response, (uint32_t)(index / 2), (uint32_t)(index % 2)) !=
        LMP_OK)
        atomic_store(&job->failed, 1);
    const unsigned done = atomic_fetch_add(&job->done, 1) + 1;
    if (job->desc->progress)
        job->desc->progress(job->desc->user, (double)done / (double)tasks);
}

static lmp_result fill_all(lmp_preintegrated_lobe *response,
                           const lmp_preintegrated_lobe_desc *desc) {
    creation job = { .response = response, .desc = desc };
    const size_t tasks = 2 * (size_t)response->info.cell_count;
    lmp_parallel_run(desc->parallel, desc->user, tasks, fill_task, &job);
    return atomic_load(&job.failed) ? LMP_ERROR_MEMORY : LMP_OK;
}

int lmp_preintegrated_lobe_valid(const lmp_preintegrated_lobe_info *info) {
    return info->bands >= 1 && info->bands <= LMP_BANDS_MAX && info->window >= LMP_WINDOW_NONE &&
           info->window <= LMP_WINDOW_LANCZOS && info->window_size >= 0 &&
           info->window_size <= 1e6f && info->error >= LMP_PREINTEGRATED_LOBE_ERROR_MIN &&
           info->error <= 0.1f;
}

lmp_result lmp_preintegrated_lobe_allocate(const lmp_allocator *allocator,
                                           const lmp_preintegrated_lobe *plan,
                                           lmp_preintegrated_lobe **response) {
    const lmp_allocator heap = lmp_allocator_resolve(allocator);
    *response = lmp_allocate(&heap, sizeof *plan + plan->info.pair_count * 2 * sizeof(int16_t));
    if (!*response)
        return LMP_ERROR_MEMORY;
    memcpy(*response, plan, sizeof *plan);
    (*response)->allocator = heap;
    (*response)->info.cells = (*response)->cells;
    (*response)->info.coefficients = (*response)->coefficients;
    (*response)->info.warp = (*response)->warp;
    return LMP_OK;
}

static lmp_result create_planned(const lmp_allocator *allocator,
                                 const lmp_preintegrated_lobe_info *info,
                                 lmp_preintegrated_lobe **response) {
    const lmp_allocator heap = lmp_allocator_resolve(allocator);
    lmp_preintegrated_lobe *plan = lmp_allocate(&heap, sizeof *plan);
    if (!plan)
        return LMP_ERROR_MEMORY;
    memset(plan, 0, sizeof *plan);
    plan->info = *info;
    const lmp_result result = lmp_preintegrated_lobe_plan(plan)
                                  ? lmp_preintegrated_lobe_allocate(allocator, plan, response)
                                  : LMP_ERROR_ARGUMENT;
    lmp_release(&heap, plan);
    return result;
}

lmp_result lmp_preintegrated_lobe_create(const lmp_allocator *allocator,
                                         const lmp_preintegrated_lobe_desc *desc,
                                         lmp_preintegrated_lobe **response) {
    static const lmp_preintegrated_lobe_desc defaults = { 0 };
    *response = NULL;
    if (!desc)
        desc = &defaults;
    const lmp_preintegrated_lobe_info info = {
        .bands = desc->bands ? desc->bands : BANDS_DEFAULT,
        .window = desc->window,
        .window_size = desc->window_size,
        .error = desc->error == 0 ? LMP_PREINTEGRATED_LOBE_ERROR_DEFAULT : desc->error,
    };
    if (!lmp_preintegrated_lobe_valid(&info))
        return LMP_ERROR_ARGUMENT;
    lmp_result result = create_planned(allocator, &info, response);
    if (result != LMP_OK)
        return result;
    result = fill_all(*response, desc);
    if (result != LMP_OK) {
        lmp_preintegrated_lobe_destroy(*response);
        *response = NULL;
    }
    return result;
}

void lmp_preintegrated_lobe_destroy(lmp_preintegrated_lobe *response) {
    if (!response)
        return;
    const lmp_allocator heap = response->allocator;
    lmp_release(&heap, response);
}

lmp_preintegrated_lobe_info lmp_preintegrated_lobe_describe(
    const lmp_preintegrated_lobe *response) {
    return response->info;
}
