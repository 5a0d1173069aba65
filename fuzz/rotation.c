/* SPDX-License-Identifier: MIT */
/* Rotations: each band keeps its norm, the inverse rotation undoes a rotation, and all
 * representations of a rotation give the same coefficients. */
#include "fuzz/numbers.h"

#include <lampion/sh.h>

enum { BANDS = 12, VALUES = LMP_SH_COUNT(BANDS) };

static double length_of(const float *sh, int first, int end) {
    double sum = 0;
    for (int i = first; i < end; i++)
        sum += (double)sh[i] * (double)sh[i];
    return sqrt(sum);
}

static double difference(int bands, const float *a, const float *b) {
    double most = 0;
    for (int i = 0; i < bands * bands; i++)
        most = fmax(most, fabs((double)a[i] - (double)b[i]));
    return most;
}

static lmp_quat take_quaternion(fuzz_input *in) {
    lmp_quat q = { fuzz_float(in, 1e-6f, 1e3f), fuzz_float(in, 1e-6f, 1e3f),
                   fuzz_float(in, 1e-6f, 1e3f), fuzz_float(in, 1e-6f, 1e3f) };
    if (q.x == 0 && q.y == 0 && q.z == 0 && q.w == 0)
        q.w = 1;
    return q;
}

static void matrix_of(lmp_quat q, float m[9]) {
    const double x = (double)q.x, y = (double)q.y, z = (double)q.z, w = (double)q.w;
    const double s = 2 / (x * x + y * y + z * z + w * w);
    const double rows[9] = { 1 - s * (y * y + z * z), s * (x * y - z * w),
                             s * (x * z + y * w),     s * (x * y + z * w),
                             1 - s * (x * x + z * z), s * (y * z - x * w),
                             s * (x * z - y * w),     s * (y * z + x * w),
                             1 - s * (x * x + y * y) };
    for (int i = 0; i < 9; i++)
        m[i] = (float)rows[i];
}

static void check_lengths(int bands, const float *before, const float *after, double bound) {
    for (int l = 0; l < bands; l++)
        fuzz_expect(fabs(length_of(before, l * l, (l + 1) * (l + 1)) -
                         length_of(after, l * l, (l + 1) * (l + 1))) <= bound);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static float matrices[LMP_SH_ROTATION_COUNT(BANDS)], others[LMP_SH_ROTATION_COUNT(BANDS)];
    fuzz_input in = { data, size };
    float sh[VALUES], rotated[VALUES], again[VALUES], m[9];
    const int bands = fuzz_int(&in, 1, BANDS);
    const lmp_quat q = take_quaternion(&in), back = { -q.x, -q.y, -q.z, q.w };
    const float angle = fuzz_float(&in, 0, 100);
    for (int i = 0; i < VALUES; i++)
        sh[i] = fuzz_float(&in, 1e-12f, 1e12f);
    const double bound = 1e-5 * bands * length_of(sh, 0, bands * bands);

    lmp_sh_make_rotation(bands, q, matrices);
    lmp_sh_rotate(bands, matrices, sh, rotated);
    check_lengths(bands, sh, rotated, bound);
    lmp_sh_make_rotation(bands, back, others);
    lmp_sh_rotate(bands, others, rotated, again);
    fuzz_expect(difference(bands, sh, again) <= bound);
    matrix_of(q, m);
    lmp_sh_make_rotation_from_matrix(bands, m, others);
    lmp_sh_rotate(bands, others, sh, again);
    fuzz_expect(difference(bands, rotated, again) <= bound);
    lmp_sh_rotate_n(bands, matrices, sh, 1, lmp_sh_interleaved(again, 0));
    fuzz_expect(difference(bands, rotated, again) <= bound);

    lmp_sh_rotate_z(bands, angle, sh, rotated);
    lmp_sh_make_rotation(bands, (lmp_quat) { 0, 0, sinf(angle / 2), cosf(angle / 2) }, matrices);
    lmp_sh_rotate(bands, matrices, sh, again);
    fuzz_expect(difference(bands, rotated, again) <= 100 * bound); /* angles are up to 100 */
    return 0;
}
