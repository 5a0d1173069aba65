/* SPDX-License-Identifier: MIT */
/* single_build.h - one build of the single calls: the file that includes it sets LMP_LANES and
 * LMP_SINGLE, and CMake its instruction set. */
#include "src/kernels/single.h"
#include "src/kernels/single_rotate.h"

typedef float single_four __attribute__((vector_size(16)));
typedef float single_eight __attribute__((vector_size(32)));

/* --- sums ------------------------------------------------------------------------------------- */

/* Eight sums side by side, then halves of them: registers of four make the same. */
LMP_INLINE float straight_dot(int bands, const float *a, const float *b) {
    const int count = bands * bands;
    single_eight wide = { 0 };
    single_four sum = { 0 };
    int i = 0;
    LMP_UNROLL for (; i + 8 <= count; i += 8) {
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

LMP_INLINE void straight_combine(int bands, float s, const float *a, float t, const float *b,
                                 float *sh) {
    const int count = bands * bands;
    int i = 0;
    LMP_UNROLL for (; i + 8 <= count; i += 8) {
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

/* Y_lm(direction), times factors[l] if they are not NULL: the recurrence of src/sh/column.h. */
LMP_INLINE void straight_values(int bands, lmp_vec3 w, const float *factors, float *sh) {
    float c = 1, s = 0;
    LMP_UNROLL for (int m = 0; m < bands; m++) {
        float before = 0, q = lmp_table_diagonal[m];
        LMP_UNROLL for (int l = m; l < bands; l++) {
            const size_t i = lmp_table_index(l, m);
            const float one = lmp_table_a[i] * w.z * q;
            const float next = l == m ? q : l == m + 1 ? one : one + lmp_table_b[i] * before;
            before = q;
            q = next;
            const float scaled = factors ? q * factors[l] : q;
            if (m > 0)
                sh[l * (l + 1) - m] = scaled * s;
            sh[l * (l + 1) + m] = m > 0 ? scaled * c : scaled;
        }
        const float next_c = m > 0 ? w.x * c - w.y * s : w.x;
        s = m > 0 ? w.x * s + w.y * c : w.y;
        c = next_c;
    }
}

/* Four values at a time are put together and multiplied in a register. */
LMP_INLINE void straight_colors(int bands, const lmp_single_cap *cap, lmp_rgb strength,
                                lmp_rgb ambient, float *const planes[3]) {
    const float by[3] = { strength.r, strength.g, strength.b };
    const float more[3] = { ambient.r, ambient.g, ambient.b };
    const int count = bands * bands;
    float sh[LMP_SINGLE_BANDS * LMP_SINGLE_BANDS];
    straight_values(bands, cap->axis, cap->factors, sh);
    LMP_UNROLL for (int i = 0; i + 4 <= count; i += 4) {
        const single_four four = { sh[i], sh[i + 1], sh[i + 2], sh[i + 3] };
        LMP_UNROLL for (int c = 0; c < 3; c++) {
            const single_four to = by[c] * four;
            memcpy(planes[c] + i, &to, sizeof to);
        }
    }
    LMP_UNROLL for (int c = 0; c < 3; c++) {
        if (count % 4 != 0)
            planes[c][count - 1] = by[c] * sh[count - 1];
        planes[c][0] = by[c] * sh[0] + more[c];
    }
}

/* --- the table -------------------------------------------------------------------------------- */

#define SINGLE_EACH(bands)                                                                         \
    static void eval_##bands(lmp_vec3 direction, float *sh) {                                      \
        straight_values(bands, direction, NULL, sh);                                               \
    }                                                                                              \
    static float dot_##bands(const float *a, const float *b) {                                     \
        return straight_dot(bands, a, b);                                                          \
    }                                                                                              \
    static void combine_##bands(float s, const float *a, float t, const float *b, float *sh) {     \
        straight_combine(bands, s, a, t, b, sh);                                                   \
    }                                                                                              \
    static void rotate_##bands(const float rotation[9], const float *sh, float *rotated) {         \
        straight_rotate(bands, rotation, sh, rotated);                                             \
    }                                                                                              \
    static void colors_##bands(const lmp_single_cap *cap, lmp_rgb strength, lmp_rgb ambient,       \
                               float *const planes[3]) {                                           \
        straight_colors(bands, cap, strength, ambient, planes);                                    \
    }
SINGLE_EACH(1)
SINGLE_EACH(2)
SINGLE_EACH(3)
SINGLE_EACH(4)
SINGLE_EACH(5)
SINGLE_EACH(6)

#define SINGLE_OF(name)                                                                            \
    { NULL, name##_1, name##_2, name##_3, name##_4, name##_5, name##_6 }

const lmp_single LMP_SINGLE = {
    .eval = SINGLE_OF(eval),
    .dot = SINGLE_OF(dot),
    .combine = SINGLE_OF(combine),
    .rotate = SINGLE_OF(rotate),
    .colors = SINGLE_OF(colors),
};
