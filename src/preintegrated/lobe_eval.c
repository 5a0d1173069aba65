/* SPDX-License-Identifier: MIT */
/* lobe_eval.c - one reading of a lobe, which the kernels and the shader do alike
 * (docs/preintegration.md). */
#include "src/preintegrated/lobe_eval.h"

#include "src/preintegrated/lobe_data.h"
#include "src/preintegrated/spline.h"

#include <assert.h>
#include <math.h>

void lmpi_preintegrated_lobe_lookup(const lmp_preintegrated_lobe_info *info, float exponent,
                                    lmpi_preintegrated_lobe_position *position) {
    const float e = fminf(fmaxf(exponent, 0), LMP_PREINTEGRATED_LOBE_EXPONENT_MAX);
    const float entry = lmp_lookup_exponent(e);
    const int i = lmp_lookup_first(entry, LMP_LOOKUP_REMAP_COUNT - 2);
    const float slice = lmp_lookup_between(info->remap[i], info->remap[i + 1], entry - (float)i);
    const int k = lmp_lookup_first(slice, (float)info->cell_count - 1);
    const lmp_preintegrated_lobe_cell *cell = &info->cells[k];
    *position = (lmpi_preintegrated_lobe_position) {
        .first = cell->first,
        .columns = cell->columns,
        .fraction = slice - (float)k,
        .density = lmp_lookup_density(cell->scale, cell->offset, e),
        .lobe_angle = lmp_lookup_solid_angle(e, info->width2),
    };
}

float lmpi_preintegrated_lobe_at(const lmp_preintegrated_lobe_info *info,
                                 const lmpi_preintegrated_lobe_position *position,
                                 float one_minus_cos, float cosine) {
    const float x = lmp_lookup_acos(cosine) * position->density;
    const float y = lmp_lookup_arc(one_minus_cos) * position->density;
    const size_t column = (size_t)x, row = (size_t)y;
    float wx[4], wy[4], sum = 0;
    lmpi_spline_weights(x - (float)column, wx);
    lmpi_spline_weights(y - (float)row, wy);
    for (size_t i = 0; i < 4; i++) {
        const int16_t *pair =
            info->coefficients + 2 * (position->first + (row + i) * position->columns + column);
        for (size_t j = 0; j < 4; j++)
            sum += wy[i] * wx[j] *
                   ((1 - position->fraction) * (float)pair[2 * j] +
                    position->fraction * (float)pair[2 * j + 1]);
    }
    const float mean = sum * LMP_PREINTEGRATED_LOBE_UNIT /
                       (2 * LMP_LOOKUP_PI * one_minus_cos + position->lobe_angle);
    return 2 / (2 - one_minus_cos) * mean;
}

float lmp_preintegrated_lobe_eval(const lmp_preintegrated_lobe *lobe, float exponent,
                                  float one_minus_cos, float cosine) {
    assert(exponent >= 0 && one_minus_cos >= 0 && one_minus_cos <= 1);
    assert(fabsf(cosine) <= 1 + LMP_UNIT_TOLERANCE);
    if (isnan(exponent) || isnan(one_minus_cos) || isnan(cosine))
        return NAN;
    lmpi_preintegrated_lobe_position position;
    lmpi_preintegrated_lobe_lookup(&lobe->info, exponent, &position);
    return lmpi_preintegrated_lobe_at(&lobe->info, &position, fminf(fmaxf(one_minus_cos, 0), 1),
                                      fminf(fmaxf(cosine, -1), 1));
}
