/* SPDX-License-Identifier: MIT */
/* brdf_eval.c - one reading of a preintegrated BRDF, which the kernels and the shader do alike. */
#include "src/base/precondition.h"
#include "src/preintegrated/brdf.h"
#include "src/preintegrated/spline.h"

/* Where a view lies among the slices. */
typedef struct view_position {
    const lmp_preintegrated_brdf_info *info;
    float cosine, sine; /* cosine and sine of theta_o */
    int32_t view;
    float fraction; /* weight of the next view */
} view_position;

/* Looks up the slice coordinate at `at` = 0 … 1 of a remap: returns the first of two slices and the
 * fraction of the second. */
static float lookup(const float *remap, uint32_t steps, uint32_t count, float at, int32_t *first) {
    const float step = fminf(fmaxf(at, 0), 1) * (float)steps;
    const int32_t i = lmp_lookup_first(step, (float)(steps - 1));
    const float slice = lmp_lookup_between(remap[i], remap[i + 1], step - (float)i);
    *first = lmp_lookup_first(slice, (float)(count - 2));
    return slice - (float)*first;
}

static void lookup_view(const lmp_preintegrated_brdf_info *info, float cos_theta_o,
                        view_position *position) {
    const float cosine = fminf(fmaxf(cos_theta_o, 0), 1);
    position->info = info;
    position->cosine = cosine;
    position->sine = sqrtf(1 - cosine * cosine);
    position->fraction = lookup(info->view_remap, info->view_steps, info->view_count,
                                lmp_lookup_arc(1 - cosine) * (2 / LMP_LOOKUP_PI), &position->view);
}

/* Adds a slice's value times `weight`. */
static void add_slice(const lmp_preintegrated_brdf_info *info,
                      const lmp_preintegrated_brdf_slice *slice, float s, float azimuth,
                      float weight, float rgb[3]) {
    const float row = s * slice->row_density - slice->row_origin;
    const float column = azimuth * slice->column_density + 1;
    const int32_t i = lmp_lookup_base(row, (float)(slice->rows - 3));
    const int32_t j = lmp_lookup_base(column, (float)(slice->columns - 3));
    float down[4], across[4], sums[12] = { 0 };
    lmpi_spline_weights(lmp_lookup_past(row, i), down);
    lmpi_spline_weights(lmp_lookup_past(column, j), across);
    const int16_t *texel =
        info->texels + 3 * (slice->first + (size_t)(i - 1) * slice->columns + (size_t)(j - 1));
    for (int k = 0; k < 4; k++, texel += 3 * (size_t)slice->columns)
        for (int n = 0; n < 12; n++)
            sums[n] += down[k] * (float)texel[n];
    const float scale = weight * slice->unit;
    for (int c = 0; c < 3; c++)
        rgb[c] += scale * (across[0] * sums[c] + across[1] * sums[3 + c] + across[2] * sums[6 + c] +
                           across[3] * sums[9 + c]);
}

/* Returns the angle of an axis from the mirror direction (-sine, 0, cosine), and its azimuth. */
static float angle_from_mirror(const view_position *position, lmp_vec3 axis, float *azimuth) {
    const float z = axis.z * position->cosine - axis.x * position->sine;
    const float x = axis.x * position->cosine + axis.z * position->sine, y = axis.y;
    *azimuth = lmp_lookup_azimuth(x, y, x * x + y * y, position->info->mirrored);
    return lmp_lookup_polar(z, x * x + y * y);
}

lmp_rgb lmp_preintegrated_brdf_eval(const lmp_preintegrated_brdf *brdf, float cos_theta_o,
                                    lmp_vec3 axis, float one_minus_cos) {
    assert(one_minus_cos >= 0 && one_minus_cos <= 1 && lmpi_is_unit(axis));
    if (isnan(cos_theta_o) || isnan(axis.x + axis.y + axis.z))
        one_minus_cos = NAN; /* every channel becomes a multiple of it */
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(brdf);
    view_position position;
    lookup_view(&info, cos_theta_o, &position);
    float azimuth, rgb[3] = { 0, 0, 0 };
    int32_t cap;
    const float g = angle_from_mirror(&position, axis, &azimuth);
    const float a = lmp_lookup_arc(one_minus_cos);
    const float s = lmp_lookup_row(g, a, info.radius, info.width, info.reach, info.slope);
    const float second =
        lookup(info.cap_remap, info.cap_steps, info.cap_count, lmp_lookup_cap(a), &cap);
    const lmp_preintegrated_brdf_slice *slice =
        info.slices + (size_t)position.view * info.cap_count + cap;
    add_slice(&info, slice, s, azimuth, (1 - position.fraction) * (1 - second), rgb);
    add_slice(&info, slice + 1, s, azimuth, (1 - position.fraction) * second, rgb);
    slice += info.cap_count;
    add_slice(&info, slice, s, azimuth, position.fraction * (1 - second), rgb);
    add_slice(&info, slice + 1, s, azimuth, position.fraction * second, rgb);
    const float scale =
        2 / ((2 - one_minus_cos) * (2 * LMP_LOOKUP_PI * one_minus_cos + info.lobe_angle));
    return (lmp_rgb) { scale * rgb[0], scale * rgb[1], scale * rgb[2] };
}

lmp_rgb lmp_preintegrated_brdf_ambient(const lmp_preintegrated_brdf *brdf, float cos_theta_o) {
    const lmp_preintegrated_brdf_info info = lmp_preintegrated_brdf_describe(brdf);
    view_position position;
    lookup_view(&info, cos_theta_o, &position);
    const lmp_rgb *a = info.ambient + position.view;
    const float t = isnan(cos_theta_o) ? cos_theta_o : position.fraction;
    return (lmp_rgb) { a[0].r + t * (a[1].r - a[0].r), a[0].g + t * (a[1].g - a[0].g),
                       a[0].b + t * (a[1].b - a[0].b) };
}
