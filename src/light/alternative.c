/* SPDX-License-Identifier: MIT */
/* The zonal coefficients in the other ways the literature writes them. */
#include "src/base/allocator.h"
#include "src/light/cap.h"

#include <lampion/light.h>

#include <assert.h>
#include <math.h>

static const float pi = 3.14159265f;

void lmp_zonal_printed(int bands, float cos_a, float *zonal) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX);
    zonal[0] = sqrtf(pi) * (1 - cos_a);
    float before = 1, now = cos_a; /* P_(l-1), P_l */
    for (int l = 1; l < bands; l++) {
        const float band = (float)l;
        const float next = ((2 * band + 1) * cos_a * now - band * before) / (band + 1);
        zonal[l] = sqrtf(pi / (2 * band + 1)) * (before - next);
        before = now;
        now = next;
    }
}

void lmp_zonal_sloan(int bands, float cos_a, float *zonal) {
    assert(bands >= 1 && bands <= LMP_ZONAL_SLOAN_BANDS);
    const float c = cos_a, c2 = c * c, s2 = (1 - c) * (1 + c);
    const float forms[LMP_ZONAL_SLOAN_BANDS] = {
        sqrtf(pi) * (1 - c),
        sqrtf(3 * pi) / 2 * s2,
        sqrtf(5 * pi) / 2 * c * s2,
        sqrtf(7 * pi) / 8 * s2 * (5 * c2 - 1),
        3 * sqrtf(pi) / 8 * c * s2 * (7 * c2 - 3),
        sqrtf(11 * pi) / 16 * s2 * (21 * c2 * c2 - 14 * c2 + 1),
    };
    for (int l = 0; l < bands; l++)
        zonal[l] = forms[l];
}

/* --- tabulated -------------------------------------------------------------------------------- */

struct lmp_zonal_table {
    lmp_allocator heap;
    int bands, size;
    float *values; /* size rows of bands */
};

/* The row of cos a = 2 place - 1. */
static void tabulate(int bands, double place, float *zonal) {
    lmp_light cap = { .kind = LMP_LIGHT_CAP, .direction = { 0, 0, 1 } };
    lmp_vec3 axis;
    cap.angle = fminf((float)(2 * acos(sqrt(place))), pi);
    lmp_light_zonal(&cap, (lmp_vec3) { 0, 0, 0 }, bands, zonal, &axis);
}

lmp_result lmp_zonal_table_create(const lmp_allocator *allocator, int bands, int size,
                                  lmp_zonal_table **table) {
    *table = NULL;
    if (bands < 1 || bands > LMP_BANDS_MAX || size < 2)
        return LMP_ERROR_ARGUMENT;
    const lmp_allocator heap = lmp_allocator_resolve(allocator);
    lmp_zonal_table *created = lmp_allocate(&heap, sizeof *created);
    if (!created)
        return LMP_ERROR_MEMORY;
    *created = (lmp_zonal_table) { .heap = heap, .bands = bands, .size = size };
    created->values = lmp_allocate(&heap, (size_t)size * (size_t)bands * sizeof(float));
    if (!created->values) {
        lmp_zonal_table_destroy(created);
        return LMP_ERROR_MEMORY;
    }
    for (int row = 0; row < size; row++)
        tabulate(bands, (double)row / (size - 1), created->values + (size_t)row * (size_t)bands);
    *table = created;
    return LMP_OK;
}

void lmp_zonal_table_destroy(lmp_zonal_table *table) {
    if (!table)
        return;
    const lmp_allocator heap = table->heap;
    lmp_release(&heap, table->values);
    lmp_release(&heap, table);
}

void lmp_zonal_table_eval(const lmp_zonal_table *table, float cos_a, float *zonal) {
    assert(cos_a >= -1 && cos_a <= 1);
    const float place = (cos_a + 1) / 2 * (float)(table->size - 1);
    const int row = place < (float)(table->size - 2) ? (int)place : table->size - 2;
    const float *low = table->values + (size_t)row * (size_t)table->bands;
    const float *high = low + table->bands;
    for (int l = 0; l < table->bands; l++)
        zonal[l] = low[l] + (place - (float)row) * (high[l] - low[l]);
}
