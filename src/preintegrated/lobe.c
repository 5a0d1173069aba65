/* SPDX-License-Identifier: MIT */
#include "src/preintegrated/lobe.h"

#include "src/base/allocator.h"
#include "src/base/parallel.h"

#include <stdatomic.h>
#include <string.h>

#define BANDS_DEFAULT 10

/* What the tasks of a creation fraction. */
typedef struct creation {
    lmp_preintegrated_lobe *lobe;
    const lmp_preintegrated_lobe_desc *desc;
    atomic_uint done;
    atomic_int result; /* lmp_result of the tasks */
} creation;

static void fill_task(size_t index, void *data) {
    creation *job = data;
    const size_t tasks = 2 * (size_t)job->lobe->info.cell_count;
    if (lmp_preintegrated_lobe_fill(job->lobe, (uint32_t)(index / 2), (uint32_t)(index % 2)) !=
        LMP_OK)
        atomic_store(&job->result, LMP_ERROR_MEMORY);
    const unsigned done = atomic_fetch_add(&job->done, 1) + 1;
    if (job->desc->progress)
        job->desc->progress(job->desc->user, (double)done / (double)tasks);
}

static lmp_result fill_all(lmp_preintegrated_lobe *lobe, const lmp_preintegrated_lobe_desc *desc) {
    creation job = { .lobe = lobe, .desc = desc };
    const size_t tasks = 2 * (size_t)lobe->info.cell_count;
    lmp_parallel_run(desc->parallel, desc->user, tasks, fill_task, &job);
    return (lmp_result)atomic_load(&job.result);
}

bool lmp_preintegrated_lobe_valid(const lmp_preintegrated_lobe_info *info) {
    return info->bands >= 1 && info->bands <= LMP_BANDS_MAX && info->window >= LMP_WINDOW_NONE &&
           info->window <= LMP_WINDOW_LANCZOS && info->window_size >= 0 &&
           info->window_size <= 1e6f && info->error >= LMP_PREINTEGRATED_LOBE_ERROR_MIN &&
           info->error <= 0.1f;
}

lmp_result lmp_preintegrated_lobe_allocate(const lmp_allocator *allocator,
                                           const lmp_preintegrated_lobe *plan,
                                           lmp_preintegrated_lobe **lobe) {
    const lmp_allocator resolved = lmp_allocator_resolve(allocator);
    *lobe = lmp_allocate(&resolved, sizeof *plan + plan->info.pair_count * 2 * sizeof(int16_t));
    if (!*lobe)
        return LMP_ERROR_MEMORY;
    memcpy(*lobe, plan, sizeof *plan);
    (*lobe)->allocator = resolved;
    (*lobe)->info.cells = (*lobe)->cells;
    (*lobe)->info.coefficients = (*lobe)->coefficients;
    (*lobe)->info.remap = (*lobe)->remap;
    return LMP_OK;
}

static lmp_result create_planned(const lmp_allocator *allocator,
                                 const lmp_preintegrated_lobe_info *info,
                                 lmp_preintegrated_lobe **lobe) {
    const lmp_allocator resolved = lmp_allocator_resolve(allocator);
    lmp_preintegrated_lobe *plan = lmp_allocate(&resolved, sizeof *plan);
    if (!plan)
        return LMP_ERROR_MEMORY;
    memset(plan, 0, sizeof *plan);
    plan->info = *info;
    lmp_result result = lmp_preintegrated_lobe_plan(plan);
    if (result == LMP_OK)
        result = lmp_preintegrated_lobe_allocate(allocator, plan, lobe);
    lmp_release(&resolved, plan);
    return result;
}

lmp_result lmp_preintegrated_lobe_create(const lmp_allocator *allocator,
                                         const lmp_preintegrated_lobe_desc *desc,
                                         lmp_preintegrated_lobe **lobe) {
    static const lmp_preintegrated_lobe_desc defaults = { 0 };
    *lobe = NULL;
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
    lmp_result result = create_planned(allocator, &info, lobe);
    if (result != LMP_OK)
        return result;
    result = fill_all(*lobe, desc);
    if (result != LMP_OK) {
        lmp_preintegrated_lobe_destroy(*lobe);
        *lobe = NULL;
    }
    return result;
}

void lmp_preintegrated_lobe_destroy(lmp_preintegrated_lobe *lobe) {
    if (!lobe)
        return;
    const lmp_allocator resolved = lobe->allocator;
    lmp_release(&resolved, lobe);
}

lmp_preintegrated_lobe_info lmp_preintegrated_lobe_describe(const lmp_preintegrated_lobe *lobe) {
    return lobe->info;
}
