/* SPDX-License-Identifier: MIT */
/* brdf_eval.c - one reading of a preintegrated BRDF; the kernels and the shader do the same. */
#include "src/preintegrated/brdf.h"
#include "src/preintegrated/spline.h"

#include <assert.h>

/* Where a view lies. */
typedef struct view_position {
    const lmp_preintegrated_brdf_info *info;
    float cosine, sine; /* of theta_o */
    uint32_t view;
    float fraction; /* of the view after it */
} view_position;

/* The slice coordinate at `fraction` of a remap, as the first of two slices and the second's
 * fraction. */
static float lookup(const float *remap, uint32_t steps, uint32_t count, float fraction,
                    uint32_t *first) {
    const float at = fminf(fmaxf(fraction, 0), 1) * (float)steps;
    const uint32_t i = at < (float)(steps - 1) ? (uint32_t)at : steps - 1;
    const float slice = remap[i] + (at - (float)i) * (remap[i + 1] - remap[i]);
    *first = slice < (float)(count - 2) ? (uint32_t)slice : count - 2;
    return slice - (float)*first;
}

static void lookup_view(const lmp_preintegrated_brdf_info *info, float cos_theta_o,
                        view_position *position) {
    const float cosine = fminf(fmaxf(cos_theta_o, 0), 1);
    const float theta = lmp_preintegrated_lobe_angle(1 - cosine);
    position->info = info;
    position->cosine = cosine;
    position->sine = sqrtf(1 - cosine * cosine);
    position->fraction = lookup(info->view_remap, info->view_steps, info->view_count,
                                theta * (float)(2 / LMP_PREINTEGRATED_PI), &position->view);
}

/* The whole part of a coordinate that leaves a neighbor before and two after among `count`. */
static uint32_t base_of(float at, uint32_t count) {
    const float most = (float)(count - 3);
    return at >= most ? count - 3 : at > 1 ? (uint32_t)at : 1;
}

/* Adds `weight` times a slice's value. */
static void add_slice(const lmp_preintegrated_brdf_info *info,
                      const lmp_preintegrated_brdf_slice *slice, float s, float azimuth,
                      float weight, float rgb[3]) {
    const float row = s * slice->row_density - slice->row_origin;
    const float column = azimuth * slice->column_density + 1;
    const uint32_t i = base_of(row, slice->rows), j = base_of(column, slice->columns);
    float down[4], across[4], sums[12] = { 0 };
    lmp_spline_weights(fminf(fmaxf(row - (float)i, 0), 1), down);
    lmp_spline_weights(fminf(fmaxf(column - (float)j, 0), 1), across);
    const int16_t *texel =
        info->texels + 3 * (slice->first + (size_t)(i - 1) * slice->columns + j - 1);
    for (int k = 0; k < 4; k++, texel += 3 * (size_t)slice->columns)
        for (int n = 0; n < 12; n++)
            sums[n] += down[k] * (float)texel[n];
    const float scale = weight * slice->unit;
    for (int c = 0; c < 3; c++)
        rgb[c] += scale * (across[0] * sums[c] + across[1] * sums[3 + c] + across[2] * sums[6 + c] +
                           across[3] * sums[9 + c]);
}

/* The axis seen from the mirror direction (-sine, 0, cosine): its angle, and the azimuth. */
static float angle_from_mirror(const view_position *position, lmp_vec3 axis, float *azimuth) {
    const float z = axis.z * position->cosine - axis.x * position->sine;
    const float x = axis.x * position->cosine + axis.z * position->sine, y = axis.y;
    const float across2 = x * x + y * y, across = sqrtf(across2);
    /* 1 - |z| without cancellation */
    const float g = lmp_preintegrated_lobe_angle(fminf(across2 / (1 + fabsf(z)), 1));
    const float cosine = across > 0 ? fminf(fabsf(x) / across, 1) : 1;
    const float quarter = lmp_preintegrated_lobe_angle(1 - cosine);
    const float half = x < 0 ? (float)LMP_PREINTEGRATED_PI - quarter : quarter;
    *azimuth = y < 0 && !position->info->mirrored ? (float)(2 * LMP_PREINTEGRATED_PI) - half : half;
    return z < 0 ? (float)LMP_PREINTEGRATED_PI - g : g;
}

lmp_rgb lmp_preintegrated_brdf_eval(const lmp_preintegrated_brdf *brdf, float cos_theta_o,
                                    lmp_vec3 axis, float one_minus_cos) {
    assert(one_minus_cos >= 0 && one_minus_cos <= 1);
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(brdf);
    view_position position;
    lookup_view(&info, cos_theta_o, &position);
    float azimuth, rgb[3] = { 0, 0, 0 };
    uint32_t cap;
    const float g = angle_from_mirror(&position, axis, &azimuth);
    const float a = lmp_preintegrated_lobe_angle(one_minus_cos);
    const float s = lmp_preintegrated_brdf_row(info.width, info.reach, info.slope,
                                               g - lmp_preintegrated_brdf_rim(info.radius, a));
    const float second =
        lookup(info.cap_remap, info.cap_steps, info.cap_count, lmp_preintegrated_brdf_cap(a), &cap);
    const lmp_preintegrated_brdf_slice *slice = info.slices + position.view * info.cap_count + cap;
    add_slice(&info, slice, s, azimuth, (1 - position.fraction) * (1 - second), rgb);
    add_slice(&info, slice + 1, s, azimuth, (1 - position.fraction) * second, rgb);
    slice += info.cap_count;
    add_slice(&info, slice, s, azimuth, position.fraction * (1 - second), rgb);
    add_slice(&info, slice + 1, s, azimuth, position.fraction * second, rgb);
    const float scale = 2 / ((2 - one_minus_cos) *
                             (2 * (float)LMP_PREINTEGRATED_PI * one_minus_cos + info.lobe_angle));
    return (lmp_rgb) { scale * rgb[0], scale * rgb[1], scale * rgb[2] };
}

lmp_rgb lmp_preintegrated_brdf_ambient(const lmp_preintegrated_brdf *brdf, float cos_theta_o) {
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(brdf);
    view_position position;
    lookup_view(&info, cos_theta_o, &position);
    const lmp_rgb *a = info.ambient + position.view;
    const float t = position.fraction;
    return (lmp_rgb) { a[0].r + t * (a[1].r - a[0].r), a[0].g + t * (a[1].g - a[0].g),
                       a[0].b + t * (a[1].b - a[0].b) };
}
