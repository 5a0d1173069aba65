/* SPDX-License-Identifier: MIT */
/* eval.c - one reading of a response; the kernels and the shader do the same (docs/shading.md). */
#include "src/response/eval.h"

#include "src/response/spline.h"

#include <assert.h>
#include <math.h>

void lmp_response_seek(const lmp_response_info *info, float exponent, lmp_response_place *place) {
    uint32_t bits, one;
    const float e = fminf(fmaxf(exponent, 0), LMP_RESPONSE_EXPONENT_MAX);
    const float shifted = 1 + e, unit = 1;
    memcpy(&bits, &shifted, sizeof bits);
    memcpy(&one, &unit, sizeof one);
    const float entry = (float)(bits - one) / (float)(1 << LMP_RESPONSE_WARP_SHIFT);
    const int i = (int)fminf(entry, (float)(LMP_RESPONSE_WARP_COUNT - 2));
    const float slice = info->warp[i] + (entry - (float)i) * (info->warp[i + 1] - info->warp[i]);
    const int k = (int)fminf(slice, (float)info->cell_count - 1);
    const lmp_response_cell *cell = &info->cells[k];
    *place = (lmp_response_place) {
        .first = cell->first,
        .columns = cell->columns,
        .share = slice - (float)k,
        .density = lmp_response_density(cell, e),
        .lobe_angle = lmp_response_lobe_angle(info, e),
    };
}

float lmp_response_at(const lmp_response_info *info, const lmp_response_place *place,
                      float one_minus, float cosine) {
    const float across = lmp_response_angle(1 - fabsf(cosine));
    const float g = cosine < 0 ? (float)LMP_RESPONSE_PI - across : across;
    const float x = g * place->density, y = lmp_response_angle(one_minus) * place->density;
    const size_t column = (size_t)x, row = (size_t)y;
    float wx[4], wy[4], sum = 0;
    lmp_spline_weights(x - (float)column, wx);
    lmp_spline_weights(y - (float)row, wy);
    for (size_t i = 0; i < 4; i++) {
        const int16_t *pair =
            info->coefficients + 2 * (place->first + (row + i) * place->columns + column);
        for (size_t j = 0; j < 4; j++)
            sum +=
                wy[i] * wx[j] *
                ((1 - place->share) * (float)pair[2 * j] + place->share * (float)pair[2 * j + 1]);
    }
    const float mean =
        sum * LMP_RESPONSE_UNIT / (2 * (float)LMP_RESPONSE_PI * one_minus + place->lobe_angle);
    return 2 / (2 - one_minus) * mean;
}

float lmp_response_eval(const lmp_response *response, float exponent, float one_minus,
                        float cosine) {
    assert(exponent >= 0 && one_minus >= 0 && one_minus <= 1);
    const lmp_response_info info = lmp_response_describe(response);
    lmp_response_place place;
    lmp_response_seek(&info, exponent, &place);
    return lmp_response_at(&info, &place, one_minus, fminf(fmaxf(cosine, -1), 1));
}
