/* SPDX-License-Identifier: MIT */
#include "app/render/zonal.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>

static const float pi = 3.14159265f;

void zonal_printed(int bands, float cos_a, float *zonal) {
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

void zonal_sloan(int bands, float cos_a, float *zonal) {
    assert(bands >= 1 && bands <= ZONAL_SLOAN_BANDS);
    const float c = cos_a, c2 = c * c, s2 = (1 - c) * (1 + c);
    const float forms[ZONAL_SLOAN_BANDS] = {
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

struct zonal_table {
    int bands, size;
    float values[]; /* `size` rows of `bands` values */
};

/* Computes the row of cos a = 2 position - 1. */
static void tabulate(int bands, double position, float *zonal) {
    lmp_light cap = { .kind = LMP_LIGHT_CAP, .direction = { 0, 0, 1 } };
    lmp_vec3 axis;
    cap.angle = fminf((float)(2 * acos(sqrt(position))), pi);
    lmp_light_project_zonal(bands, &cap, (lmp_vec3) { 0, 0, 0 }, zonal, &axis);
}

zonal_table *zonal_table_create(int bands, int size) {
    assert(bands >= 1 && bands <= LMP_BANDS_MAX && size >= 2);
    const size_t values = (size_t)size * (size_t)bands;
    zonal_table *table = malloc(sizeof *table + values * sizeof *table->values);
    if (!table)
        return NULL;
    table->bands = bands;
    table->size = size;
    for (int row = 0; row < size; row++)
        tabulate(bands, (double)row / (size - 1), table->values + (size_t)row * (size_t)bands);
    return table;
}

void zonal_table_destroy(zonal_table *table) {
    free(table);
}

/* Clamps to the ends outside -1 … 1; NaN gives NaN. */
void zonal_table_eval(const zonal_table *table, float cos_a, float *zonal) {
    const float last = (float)(table->size - 1);
    const float position = cos_a > -1 ? fminf((cos_a + 1) / 2 * last, last) : 0;
    const int row = position < last ? (int)position : table->size - 2;
    const float fraction = isnan(cos_a) ? cos_a : position - (float)row;
    const float *low = table->values + (size_t)row * (size_t)table->bands;
    const float *high = low + table->bands;
    for (int l = 0; l < table->bands; l++)
        zonal[l] = low[l] + fraction * (high[l] - low[l]);
}
