/* SPDX-License-Identifier: MIT */
#include "src/preintegrated/lobe.h"

#include "src/base/host.h"
#include "src/preintegrated/lobe_fill.h"
#include "src/preintegrated/lobe_plan.h"

#include <string.h>

#define BANDS_DEFAULT 10

static lmp_result fill_task(size_t index, void *data) {
    return lmpi_preintegrated_lobe_fill(data, (uint32_t)(index / 2), (uint32_t)(index % 2));
}

bool lmpi_preintegrated_lobe_valid(const lmp_preintegrated_lobe_info *info) {
    return info->bands >= 1 && info->bands <= LMP_BANDS_MAX && info->window >= LMP_WINDOW_NONE &&
           info->window < LMP_WINDOW_COUNT && info->window_size >= 0 && info->window_size <= 1e6f &&
           info->error >= LMP_PREINTEGRATED_LOBE_ERROR_MIN && info->error <= 0.1f;
}

lmp_result lmpi_preintegrated_lobe_allocate(const lmp_host *host,
                                            const lmp_preintegrated_lobe *plan,
                                            lmp_preintegrated_lobe **lobe) {
    const lmp_host resolved = lmpi_host_resolve(host);
    *lobe = lmpi_allocate(&resolved, sizeof *plan + plan->info.pair_count * 2 * sizeof(int16_t));
    if (!*lobe)
        return LMP_ERROR_MEMORY;
    memcpy(*lobe, plan, sizeof *plan);
    (*lobe)->host = resolved;
    (*lobe)->info.cells = (*lobe)->cells;
    (*lobe)->info.coefficients = (*lobe)->coefficients;
    (*lobe)->info.remap = (*lobe)->remap;
    return LMP_OK;
}

static lmp_result create_planned(const lmp_host *host, const lmp_preintegrated_lobe_info *info,
                                 lmp_preintegrated_lobe **lobe) {
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_preintegrated_lobe *plan = lmpi_allocate(&resolved, sizeof *plan);
    if (!plan)
        return LMP_ERROR_MEMORY;
    memset(plan, 0, sizeof *plan);
    plan->info = *info;
    lmp_result result = lmpi_preintegrated_lobe_plan(plan);
    if (result == LMP_OK)
        result = lmpi_preintegrated_lobe_allocate(host, plan, lobe);
    lmpi_release(&resolved, plan);
    return result;
}

lmp_result lmp_preintegrated_lobe_create(const lmp_host *host,
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
    if (!lmpi_preintegrated_lobe_valid(&info))
        return LMP_ERROR_ARGUMENT;
    lmp_result result = create_planned(host, &info, lobe);
    if (result != LMP_OK)
        return result;
    const size_t slices = 2 * (size_t)(*lobe)->info.cell_count;
    result = lmpi_host_run(&(*lobe)->host, 0, 1, slices, fill_task, *lobe);
    if (result != LMP_OK) {
        lmp_preintegrated_lobe_destroy(*lobe);
        *lobe = NULL;
    }
    return result;
}

void lmp_preintegrated_lobe_destroy(lmp_preintegrated_lobe *lobe) {
    lmpi_release_object(lobe);
}

lmp_preintegrated_lobe_info lmp_preintegrated_lobe_describe(const lmp_preintegrated_lobe *lobe) {
    return lobe->info;
}
