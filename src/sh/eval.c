/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"
#include "src/kernels/dispatch.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <string.h>

/* Bands up to which lmp_sh_combine does without kernels. */
#define COMBINE_HERE 4

void lmpi_sh_values(int bands, lmp_vec3 direction, float *sh) {
    if (bands <= LMPI_SINGLE_BANDS) {
        lmpi_single_get()->eval[bands](bands, direction, sh);
        return;
    }
    LMPI_STRAIGHT_SMALL(bands, lmpi_sh_put, direction, NULL, NULL, sh)
}

void lmp_sh_eval(int bands, lmp_vec3 direction, float *sh) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_is_unit(direction));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    (kernels ? kernels->single->eval[bands] : lmpi_sh_values)(bands, direction, sh);
}

void lmpi_sh_zonal_bands(int low, int high, const float *factors, lmp_vec3 axis, float *sh) {
    const size_t first = LMP_SH_COUNT(low);
    float q[LMP_BANDS_MAX];
    lmpi_azimuth a = { 1, 0 };
    for (int m = 0; m < high; m++) {
        lmpi_sh_column(high, m, axis.z, q);
        for (int l = m > low ? m : low; l < high; l++) {
            sh[LMP_SH_INDEX(l, -m) - first] = factors[l] * q[l] * a.s;
            sh[LMP_SH_INDEX(l, m) - first] = factors[l] * q[l] * a.c;
        }
        a = lmpi_azimuth_next(a, axis);
    }
}

static LMPI_NOINLINE float dot_any(int bands, const float *a, const float *b) {
    if (bands <= LMPI_SINGLE_BANDS)
        return lmpi_single_get()->dot[bands](bands, a, b);
    float sum = 0;
    for (int l = 0; l < bands; l++) {
        float band = 0;
        for (int m = -l; m <= l; m++)
            band += a[LMP_SH_INDEX(l, m)] * b[LMP_SH_INDEX(l, m)];
        sum += band;
    }
    return sum;
}

float lmp_sh_dot(int bands, const float *a, const float *b) {
    assert(lmpi_is_bands(bands));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    return (kernels ? kernels->single->dot[bands] : dot_any)(bands, a, b);
}

float lmp_sh_reconstruct(int bands, const float *sh, lmp_vec3 direction) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit(direction));
    if (bands <= LMPI_SINGLE_BANDS) {
        const lmpi_single *single = lmpi_single_get();
        float values[LMP_SH_COUNT(LMPI_SINGLE_BANDS)];
        single->eval[bands](bands, direction, values);
        return single->dot[bands](bands, values, sh);
    }
    float q[LMP_BANDS_MAX], sum = 0;
    lmpi_azimuth a = { 1, 0 };
    for (int m = 0; m < bands; m++) {
        lmpi_sh_column(bands, m, direction.z, q);
        float cosine = 0, sine = 0;
        for (int l = m; l < bands; l++) {
            cosine += q[l] * sh[LMP_SH_INDEX(l, m)];
            sine += q[l] * sh[LMP_SH_INDEX(l, -m)];
        }
        sum += cosine * a.c + sine * a.s;
        a = lmpi_azimuth_next(a, direction);
    }
    return sum;
}

void lmp_sh_expand_zonal(int bands, const float *zonal, lmp_vec3 axis, float *sh) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit(axis));
    assert(lmpi_are_apart(zonal, (size_t)bands, sh, LMP_SH_COUNT(bands)));
    if (bands <= LMPI_SINGLE_BANDS) {
        lmpi_single_cap cap = { .axis = axis };
        for (int l = 0; l < bands; l++)
            cap.factors[l] = zonal[l] / lmpi_table_pole[l];
        lmpi_single_get()->cap[bands](&cap, sh);
        return;
    }
    float weights[LMP_BANDS_MAX];
    for (int l = 0; l < bands; l++)
        weights[l] = zonal[l] / lmpi_table_pole[l];
    lmp_sh_eval(bands, axis, sh);
    lmp_sh_apply_window(bands, weights, sh, sh);
}

static LMPI_NOINLINE void combine_any(int bands, float s, const float *a, float t, const float *b,
                                      float *sh) {
    if (bands > COMBINE_HERE && bands <= LMPI_SINGLE_BANDS)
        lmpi_single_get()->combine[bands](bands, s, a, t, b, sh);
    else
        for (size_t i = 0; i < LMP_SH_COUNT(bands); i++)
            sh[i] = s * a[i] + t * b[i];
}

/* Combines so few bands that the way to an instruction set's function would take as long. */
LMPI_INLINE void combine_here(int bands, float s, const float *a, float t, const float *b,
                              float *sh) {
    const int count = bands * bands;
    LMPI_UNROLL for (int i = 0; i + 4 <= count; i += 4) {
        typedef float four __attribute__((vector_size(16)));
        four x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        x = s * x + t * y;
        memcpy(sh + i, &x, sizeof x);
    }
    if (count % 4 != 0)
        sh[count - 1] = s * a[count - 1] + t * b[count - 1];
}

void lmp_sh_combine(int bands, float s, const float *a, float t, const float *b, float *sh) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_are_same_or_apart(a, sh, LMP_SH_COUNT(bands)));
    assert(lmpi_are_same_or_apart(b, sh, LMP_SH_COUNT(bands)));
    const lmpi_kernels *kernels = lmpi_single_for(bands);
    if (bands == 4)
        combine_here(4, s, a, t, b, sh);
    else if (bands == 3)
        combine_here(3, s, a, t, b, sh);
    else if (bands == 2)
        combine_here(2, s, a, t, b, sh);
    else
        (kernels && bands > COMBINE_HERE ? kernels->single->combine[bands]
                                         : combine_any)(bands, s, a, t, b, sh);
}

/* --- gradient --------------------------------------------------------------------------------- */

/* Stores the derivatives of the polynomial q(z) C without their part along the direction w, which
 * are those of Y(v/|v|) at w. */
static void put_gradient(lmp_vec3 g, lmp_vec3 w, size_t i, size_t plane, float *gradient) {
    const float along = g.x * w.x + g.y * w.y + g.z * w.z;
    gradient[i] = g.x - along * w.x;
    gradient[plane + i] = g.y - along * w.y;
    gradient[2 * plane + i] = g.z - along * w.z;
}

void lmp_sh_eval_gradient(int bands, lmp_vec3 direction, float *sh, float *gradient) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_is_unit(direction));
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), gradient, 3 * LMP_SH_COUNT(bands)));
    const size_t plane = LMP_SH_COUNT(bands);
    float q[LMP_BANDS_MAX + 1], above[LMP_BANDS_MAX + 1]; /* q_l^m and q_l^(m+1) */
    lmpi_azimuth a = { 1, 0 }, below = { 0, 0 };          /* (x + iy)^m and (x + iy)^(m-1) */
    lmpi_sh_column(bands, 0, direction.z, q);
    for (int m = 0; m < bands; m++) {
        const float *slope = lmpi_table_slope + lmpi_table_index(m, m), k = (float)m;
        above[m] = 0;
        if (m + 1 < bands)
            lmpi_sh_column(bands, m + 1, direction.z, above);
        for (int l = m; l < bands; l++) {
            const float dz = slope[l - m] * above[l];
            const lmp_vec3 sine = { k * q[l] * below.s, k * q[l] * below.c, dz * a.s };
            const lmp_vec3 cosine = { k * q[l] * below.c, -k * q[l] * below.s, dz * a.c };
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            sh[LMP_SH_INDEX(l, -m)] = q[l] * a.s;
            put_gradient(sine, direction, LMP_SH_INDEX(l, -m), plane, gradient);
            sh[LMP_SH_INDEX(l, m)] = q[l] * a.c;
            put_gradient(cosine, direction, LMP_SH_INDEX(l, m), plane, gradient);
        }
        below = a;
        a = lmpi_azimuth_next(a, direction);
        for (int l = m + 1; l < bands; l++)
            q[l] = above[l];
    }
}
