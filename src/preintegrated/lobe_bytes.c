/* SPDX-License-Identifier: MIT */
/* lobe_bytes.c - the file format .lmpr (docs/formats.md): what cannot be derived, then the
 * coefficients. */
#include "src/base/bytes.h"

#include "src/base/host.h"
#include "src/base/parse_error.h"
#include "src/preintegrated/lobe.h"
#include "src/preintegrated/lobe_plan.h"

#define HEADER 32u
/* The most nodes per radian: three times what 128 bands need, and 1024 such cells have fewer than
 * 2^32 pairs. */
#define DENSITY_MAX 512
static const lmpi_bytes_format format = { .name = "preintegrated lobe (.lmpr)",
                                          .magic = { 'L', 'M', 'P', 'R', 0x0d, 0x0a, 0x1a, 0x0a },
                                          .version = 1,
                                          .header = HEADER };

static size_t plan_size(uint32_t cells) {
    return 4 * LMP_PREINTEGRATED_LOBE_REMAP_COUNT + 8 * (size_t)cells;
}

size_t lmp_preintegrated_lobe_size(const lmp_preintegrated_lobe *lobe) {
    const lmp_preintegrated_lobe_info *info = &lobe->info;
    return HEADER + plan_size(info->cell_count) + 4 * info->pair_count + LMPI_BYTES_CHECKSUM;
}

lmp_result lmp_preintegrated_lobe_write(const lmp_preintegrated_lobe *lobe, size_t size,
                                        void *bytes) {
    const lmp_preintegrated_lobe_info *info = &lobe->info;
    if (size < lmp_preintegrated_lobe_size(lobe))
        return LMP_ERROR_ARGUMENT;
    unsigned char *p = lmpi_bytes_begin(bytes, &format);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->bands);
    p = lmpi_bytes_store_u32(p, (uint32_t)info->window);
    p = lmpi_bytes_store_f32(p, info->window_size);
    p = lmpi_bytes_store_f32(p, info->error);
    p = lmpi_bytes_store_u32(p, info->cell_count);
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        p = lmpi_bytes_store_f32(p, lobe->remap[i]);
    for (uint32_t k = 0; k < info->cell_count; k++) {
        p = lmpi_bytes_store_f32(p, lobe->cells[k].scale);
        p = lmpi_bytes_store_f32(p, lobe->cells[k].offset);
    }
    for (size_t i = 0; i < 2 * info->pair_count; i++)
        p = lmpi_bytes_store_u16(p, (uint16_t)lobe->coefficients[i]);
    lmpi_bytes_end(bytes, p);
    return LMP_OK;
}

/* Whether every reading stays inside: the remap rises from 0 to the last slice, and grids are
 * finite. */
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

/* Reads the members of the header, and says which of them is wrong. */
static lmp_result read_header(const unsigned char *bytes, size_t size,
                              lmp_preintegrated_lobe_info *info, lmp_parse_error *error) {
    const unsigned char *p = bytes + LMPI_BYTES_BEGIN;
    const uint32_t bands = lmpi_bytes_load_u32(&p), window = lmpi_bytes_load_u32(&p);
    if (bands > LMP_BANDS_MAX || window >= LMP_WINDOW_COUNT)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, LMPI_BYTES_BEGIN,
                               "%zu bands or window %zu is not valid", (size_t)bands,
                               (size_t)window);
    info->bands = (int)bands;
    info->window = (lmp_window)window;
    info->window_size = lmpi_bytes_load_f32(&p);
    info->error = lmpi_bytes_load_f32(&p);
    info->cell_count = lmpi_bytes_load_u32(&p);
    if (!lmpi_preintegrated_lobe_valid(info))
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, LMPI_BYTES_BEGIN,
                               "bands, window or error is out of range");
    if (info->cell_count < 1 || info->cell_count > LOBE_CELLS_MAX ||
        size < HEADER + plan_size(info->cell_count) + LMPI_BYTES_CHECKSUM)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, HEADER - 4,
                               "%zu cells do not fit in %zu bytes", (size_t)info->cell_count, size);
    return LMP_OK;
}

static lmp_result read_plan(const unsigned char *bytes, size_t size, lmp_preintegrated_lobe *plan,
                            lmp_parse_error *error) {
    lmp_preintegrated_lobe_info *info = &plan->info;
    const unsigned char *p = bytes + HEADER;
    const lmp_result result = read_header(bytes, size, info, error);
    if (result != LMP_OK)
        return result;
    for (int i = 0; i < LMP_PREINTEGRATED_LOBE_REMAP_COUNT; i++)
        plan->remap[i] = lmpi_bytes_load_f32(&p);
    for (uint32_t k = 0; k < info->cell_count; k++) {
        plan->cells[k].scale = lmpi_bytes_load_f32(&p);
        plan->cells[k].offset = lmpi_bytes_load_f32(&p);
    }
    if (!remap_valid(plan))
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, HEADER,
                               "the coordinates of slices do not rise from 0 to the last slice");
    lmpi_preintegrated_lobe_exponents(plan);
    if (!cells_valid(plan))
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT,
                               HEADER + 4 * LMP_PREINTEGRATED_LOBE_REMAP_COUNT,
                               "the grid of a cell is not valid");
    lmpi_preintegrated_lobe_layout(plan);
    const size_t wanted =
        HEADER + plan_size(info->cell_count) + 4 * info->pair_count + LMPI_BYTES_CHECKSUM;
    if (size != wanted)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, size,
                               "its cells need %zu bytes, the file has %zu", wanted, size);
    return LMP_OK;
}

lmp_result lmp_preintegrated_lobe_read(const lmp_host *host, const void *data, size_t size,
                                       lmp_parse_error *error, lmp_preintegrated_lobe **lobe) {
    *lobe = NULL;
    const unsigned char *bytes = data;
    lmp_result result = lmpi_bytes_check_frame(bytes, size, &format, error);
    if (result != LMP_OK)
        return result;
    const lmp_host resolved = lmpi_host_resolve(host);
    lmp_preintegrated_lobe *plan = lmpi_allocate(&resolved, sizeof *plan);
    if (!plan)
        return lmpi_parse_fail(error, LMP_ERROR_MEMORY, 0, "out of memory for the lobe");
    memset(plan, 0, sizeof *plan);
    result = read_plan(bytes, size, plan, error);
    if (result == LMP_OK) {
        result = lmpi_preintegrated_lobe_allocate(host, plan, lobe);
        if (result != LMP_OK)
            lmpi_parse_fail(error, result, 0, "out of memory for the lobe");
    }
    lmpi_release(&resolved, plan);
    if (result != LMP_OK)
        return result;
    const unsigned char *p = bytes + size - LMPI_BYTES_CHECKSUM - 4 * (*lobe)->info.pair_count;
    lmpi_bytes_load_i16s(p, 2 * (*lobe)->info.pair_count, (*lobe)->coefficients);
    return LMP_OK;
}
