/* SPDX-License-Identifier: MIT */
/* lobe_bytes.c - the file format .lmpr (docs/formats.md): what cannot be derived, then the
 * coefficients.
 */
#include "src/base/bytes.h"

#include "src/base/host.h"
#include "src/preintegrated/lobe.h"

#define HEADER 32u
/* Nodes a radian: three times what 128 bands take, and 1024 cells of it count below 2^32 pairs. */
#define DENSITY_MAX 512
static const lmp_bytes_format format = { .magic = { 'L', 'M', 'P', 'R', 0x0d, 0x0a, 0x1a, 0x0a },
                                         .version = 1,
                                         .header = HEADER };

static size_t plan_size(uint32_t cells) {
    return 4 * LMP_PREINTEGRATED_LOBE_REMAP_COUNT + 8 * (size_t)cells;
}

size_t lmp_preintegrated_lobe_size(const lmp_preintegrated_lobe *lobe) {
    const lmp_preintegrated_lobe_info *info = &lobe->info;
    return HEADER + plan_size(info->cell_count) + 4 * info->pair_count + LMP_BYTES_CHECKSUM;
}

void lmp_preintegrated_lobe_write(const lmp_preintegrated_lobe *lobe, void *bytes) {
    const lmp_preintegrated_lobe_info *info = &lobe->info;
    unsigned char *p = lmp_bytes_begin(bytes, &format);
    p = lmp_bytes_store_u32(p, (uint32_t)info->bands);
    p = lmp_bytes_store_u32(p, (uint32_t)info->window);
    p = lmp_bytes_store_f32(p, info->window_size);
    p = lmp_bytes_store_f32(p, info->error);
    p = lmp_bytes_store_u32(p, info->cell_count);
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        p = lmp_bytes_store_f32(p, lobe->remap[i]);
    for (uint32_t k = 0; k < info->cell_count; k++) {
        p = lmp_bytes_store_f32(p, lobe->cells[k].scale);
        p = lmp_bytes_store_f32(p, lobe->cells[k].offset);
    }
    for (size_t i = 0; i < 2 * info->pair_count; i++)
        p = lmp_bytes_store_u16(p, (uint16_t)lobe->coefficients[i]);
    lmp_bytes_end(bytes, p);
}

/* Every reading stays inside: the remap rises from 0 to the last slice, and grids are finite. */
static bool remap_valid(const lmp_preintegrated_lobe *plan) {
    for (int i = 1; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        if (!(plan->remap[i] > plan->remap[i - 1]))
            return false;
    return plan->remap[0] >= 0 && plan->remap[0] <= 0 &&
           plan->remap[LMP_PREINTEGRATED_LOBE_REMAP_COUNT - 1] <= (float)plan->info.cell_count;
}

static bool cells_valid(const lmp_preintegrated_lobe *plan) {
    for (uint32_t k = 0; k < plan->info.cell_count; k++)
        if (!(plan->cells[k].scale >= 0) || !(plan->cells[k].offset >= 0) ||
            !(lmp_lookup_density(plan->cells[k].scale, plan->cells[k].offset,
                                 plan->exponents[k + 1]) <= DENSITY_MAX))
            return false;
    return true;
}

static lmp_result read_plan(const unsigned char *bytes, size_t size, lmp_preintegrated_lobe *plan) {
    lmp_preintegrated_lobe_info *info = &plan->info;
    const unsigned char *p = bytes + LMP_BYTES_BEGIN;
    const uint32_t bands = lmp_bytes_load_u32(&p), window = lmp_bytes_load_u32(&p);
    if (bands > LMP_BANDS_MAX || window >= LMP_WINDOWS)
        return LMP_ERROR_FORMAT;
    info->bands = (int)bands;
    info->window = (lmp_window)window;
    info->window_size = lmp_bytes_load_f32(&p);
    info->error = lmp_bytes_load_f32(&p);
    info->cell_count = lmp_bytes_load_u32(&p);
    if (!lmp_preintegrated_lobe_valid(info) || info->cell_count < 1 ||
        info->cell_count > LOBE_CELLS_MAX ||
        size < HEADER + plan_size(info->cell_count) + LMP_BYTES_CHECKSUM)
        return LMP_ERROR_FORMAT;
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        plan->remap[i] = lmp_bytes_load_f32(&p);
    for (uint32_t k = 0; k < info->cell_count; k++) {
        plan->cells[k].scale = lmp_bytes_load_f32(&p);
        plan->cells[k].offset = lmp_bytes_load_f32(&p);
    }
    if (!remap_valid(plan))
        return LMP_ERROR_FORMAT;
    lmp_preintegrated_lobe_exponents(plan);
    if (!cells_valid(plan))
        return LMP_ERROR_FORMAT;
    lmp_preintegrated_lobe_layout(plan);
    return size == HEADER + plan_size(info->cell_count) + 4 * info->pair_count + LMP_BYTES_CHECKSUM
               ? LMP_OK
               : LMP_ERROR_FORMAT;
}

lmp_result lmp_preintegrated_lobe_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_preintegrated_lobe **lobe) {
    *lobe = NULL;
    const unsigned char *bytes = data;
    lmp_result result = lmp_bytes_check_frame(bytes, size, &format);
    if (result != LMP_OK)
        return result;
    const lmp_host resolved = lmp_host_resolve(host);
    lmp_preintegrated_lobe *plan = lmp_allocate(&resolved, sizeof *plan);
    if (!plan)
        return LMP_ERROR_MEMORY;
    memset(plan, 0, sizeof *plan);
    result = read_plan(bytes, size, plan);
    if (result == LMP_OK)
        result = lmp_preintegrated_lobe_allocate(host, plan, lobe);
    lmp_release(&resolved, plan);
    if (result != LMP_OK)
        return result;
    const unsigned char *p = bytes + size - LMP_BYTES_CHECKSUM - 4 * (*lobe)->info.pair_count;
    lmp_bytes_load_i16s(p, 2 * (*lobe)->info.pair_count, (*lobe)->coefficients);
    return LMP_OK;
}
