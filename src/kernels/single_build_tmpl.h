/* SPDX-License-Identifier: MIT */
/* single_build_tmpl.h - one build of the single calls: the file that includes it sets LMPI_LANES
 * and LMPI_SINGLE, and CMake its instruction set. */
#include "src/kernels/lanes.h"
#include "src/kernels/single.h"
#include "src/kernels/single_product_tmpl.h"
#include "src/kernels/single_rotate_tmpl.h"
#include "src/kernels/single_rotate_z_tmpl.h"
#include "src/kernels/single_values_tmpl.h"

/* --- sums ------------------------------------------------------------------------------------- */

/* Returns a dot product as eight sums side by side, then halves of them, which registers of four
 * compute alike. */
LMPI_INLINE float straight_dot(int bands, const float *a, const float *b) {
    const int count = bands * bands;
    single_eight wide = { 0 };
    single_four sum = { 0 };
    int i = 0;
    LMPI_UNROLL for (; i + 8 <= count; i += 8) {
        single_eight x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        wide = i == 0 ? x * y : wide + x * y;
    }
    if (count >= 8) {
        single_four half[2];
        memcpy(half, &wide, sizeof half);
        sum = half[0] + half[1];
    }
    if (count % 8 >= 4) {
        single_four x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        sum = count < 8 ? x * y : sum + x * y;
        i += 4;
    }
    const float total = (sum[0] + sum[2]) + (sum[1] + sum[3]);
    return count < 4 ? a[0] * b[0] : i < count ? total + a[i] * b[i] : total;
}

LMPI_INLINE void straight_combine(int bands, float s, const float *a, float t, const float *b,
                                  float *sh) {
    const int count = bands * bands;
    int i = 0;
    LMPI_UNROLL for (; i + 8 <= count; i += 8) {
        single_eight x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        x = s * x + t * y;
        memcpy(sh + i, &x, sizeof x);
    }
    if (count % 8 >= 4) {
        single_four x, y;
        memcpy(&x, a + i, sizeof x);
        memcpy(&y, b + i, sizeof y);
        x = s * x + t * y;
        memcpy(sh + i, &x, sizeof x);
        i += 4;
    }
    if (i < count)
        sh[i] = s * a[i] + t * b[i];
}

/* --- values ----------------------------------------------------------------------------------- */

LMPI_INLINE void straight_eval(int bands, lmp_vec3 direction, float *sh) {
    if (bands == 1) {
        sh[0] = lmpi_table_diagonal[0];
        return;
    }
    single_values values;
    single_values_of(bands, &direction, NULL, &values);
    single_values_store(bands, &values, sh);
}

LMPI_INLINE void straight_cap(int bands, const lmpi_single_cap *cap, float *sh) {
    if (bands == 1) {
        sh[0] = lmpi_table_diagonal[0] * cap->factors[0];
        return;
    }
    single_values values;
    single_values_of(bands, &cap->axis, cap->factors, &values);
    single_values_store(bands, &values, sh);
}

LMPI_INLINE void straight_sun(int bands, lmp_vec3 axis, lmp_rgb strength, float *const planes[3]) {
    const float by[3] = { strength.r, strength.g, strength.b };
    single_values values;
    if (bands > 1)
        single_values_of(bands, &axis, NULL, &values);
    LMPI_UNROLL for (int c = 0; c < 3; c++) {
        if (bands == 1)
            planes[c][0] = by[c] * lmpi_table_diagonal[0];
        else
            single_values_store_times(bands, &values, by[c], planes[c]);
    }
}

LMPI_INLINE void straight_colors(int bands, const lmpi_single_cap *cap, lmp_rgb strength,
                                 lmp_rgb ambient, float *const planes[3]) {
    const float by[3] = { strength.r, strength.g, strength.b };
    const float more[3] = { ambient.r, ambient.g, ambient.b };
    const float first = lmpi_table_diagonal[0] * cap->factors[0];
    single_values values;
    if (bands > 1)
        single_values_of(bands, &cap->axis, cap->factors, &values);
    LMPI_UNROLL for (int c = 0; c < 3; c++) {
        if (bands > 1)
            single_values_store_times(bands, &values, by[c], planes[c]);
        planes[c][0] = by[c] * first + more[c];
    }
}

/* --- the table -------------------------------------------------------------------------------- */

#define SINGLE_EACH(bands)                                                                         \
    static void eval_##bands(int n, lmp_vec3 direction, float *sh) {                               \
        (void)n;                                                                                   \
        straight_eval(bands, direction, sh);                                                       \
    }                                                                                              \
    static float dot_##bands(int n, const float *a, const float *b) {                              \
        (void)n;                                                                                   \
        return straight_dot(bands, a, b);                                                          \
    }                                                                                              \
    static void multiply_##bands(int n, const float *a, const float *b, float *c) {                \
        (void)n;                                                                                   \
        straight_multiply(bands, a, b, c);                                                         \
    }                                                                                              \
    static void rotate_##bands(int n, const float rotation[9], const float *sh, float *rotated) {  \
        (void)n;                                                                                   \
        straight_rotate(bands, rotation, sh, rotated);                                             \
    }                                                                                              \
    static void rotate_z_##bands(int n, float angle, const float *sh, float *rotated) {            \
        (void)n;                                                                                   \
        straight_rotate_z(bands, angle, sh, rotated);                                              \
    }                                                                                              \
    static void cap_##bands(const lmpi_single_cap *cap, float *sh) {                               \
        straight_cap(bands, cap, sh);                                                              \
    }                                                                                              \
    static void colors_##bands(const lmpi_single_cap *cap, lmp_rgb strength, lmp_rgb ambient,      \
                               float *const planes[3]) {                                           \
        straight_colors(bands, cap, strength, ambient, planes);                                    \
    }                                                                                              \
    static void sun_##bands(lmp_vec3 axis, lmp_rgb strength, float *red, float *green,             \
                            float *blue) {                                                         \
        straight_sun(bands, axis, strength, (float *const[3]) { red, green, blue });               \
    }
static void combine_5(int n, float s, const float *a, float t, const float *b, float *sh) {
    (void)n;
    straight_combine(5, s, a, t, b, sh);
}
static void combine_6(int n, float s, const float *a, float t, const float *b, float *sh) {
    (void)n;
    straight_combine(6, s, a, t, b, sh);
}
SINGLE_EACH(1)
SINGLE_EACH(2)
SINGLE_EACH(3)
SINGLE_EACH(4)
SINGLE_EACH(5)
SINGLE_EACH(6)

#define SINGLE_OF(name)                                                                            \
    { NULL, name##_1, name##_2, name##_3, name##_4, name##_5, name##_6 }

const lmpi_single LMPI_SINGLE = {
    .eval = SINGLE_OF(eval),
    .dot = SINGLE_OF(dot),
    .combine = { [5] = combine_5, [6] = combine_6 },
    .multiply = SINGLE_OF(multiply),
    .rotate = SINGLE_OF(rotate),
    .rotate_z = SINGLE_OF(rotate_z),
    .cap = SINGLE_OF(cap),
    .colors = SINGLE_OF(colors),
    .sun = SINGLE_OF(sun),
};
