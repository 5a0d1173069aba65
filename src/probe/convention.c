/* SPDX-License-Identifier: MIT */
#include "src/base/precondition.h"

#include <lampion/probe.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

/* Returns a convention's basis functions of even order m relative to this library's, and so their
 * coefficients. */
static double factor(const lmp_probe_convention *convention, int l) {
    return convention->normalization == LMP_PROBE_N3D    ? sqrt(4 * pi)
           : convention->normalization == LMP_PROBE_SN3D ? sqrt(4 * pi / (2 * l + 1))
                                                         : 1;
}

/* Returns the same of odd order, relative to even order. */
static double odd_sign(const lmp_probe_convention *convention) {
    return convention->sign == LMP_PROBE_SIGN_POSITIVE ? -1 : 1;
}

/* --- axes ------------------------------------------------------------------------------------- */

/* Fills in rows: the axes of a convention in this library's world. */
static void axes_of(const lmp_probe_convention *convention, int axes[3][3]) {
    for (int row = 0; row < 3; row++) {
        const int axis = convention->axes[row] ? convention->axes[row] : row + 1;
        assert(abs(axis) <= 3);
        for (int column = 0; column < 3; column++)
            axes[row][column] = abs(axis) != column + 1 ? 0 : axis > 0 ? 1 : -1;
    }
}

static int determinant(int m[3][3]) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* Mirrors z by Y_lm(x, y, -z) = (-1)^(l+m) Y_lm(x, y, z). */
static void mirror_z(int bands, float *sh) {
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            if ((l + m) % 2 != 0)
                sh[LMP_SH_INDEX(l, m)] = -sh[LMP_SH_INDEX(l, m)];
}

/* Turns f(w) into f(M w), with M a rotation, or one times a reflection of z. */
static void change_axes(int bands, int m[3][3], float *sh) {
    static const int unchanged[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    const bool mirrored = determinant(m) < 0;
    float inverse[9], rotated[LMP_SH_COUNT(LMP_PROBE_AXES_BANDS_MAX)];
    if (memcmp(m, unchanged, sizeof unchanged) == 0)
        return;
    assert(bands <= LMP_PROBE_AXES_BANDS_MAX);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            inverse[3 * column + row] =
                (float)(mirrored && column == 2 ? -m[row][column] : m[row][column]);
    lmp_sh_rotate_by_matrix(bands, inverse, sh, rotated);
    memcpy(sh, rotated, LMP_SH_COUNT(bands) * sizeof *sh);
    if (mirrored)
        mirror_z(bands, sh);
}

/* --- conversion ------------------------------------------------------------------------------- */

/* Multiplies a band, and once more its odd orders. */
static void scale_band(int l, double even, double odd, const float *from, float *to) {
    const int middle = l * l + l;
    for (int i = middle - l; i <= middle + l; i++)
        to[i] = (float)((double)from[i] * ((i - middle) % 2 != 0 ? even * odd : even));
}

void lmp_probe_convert(int bands, const lmp_probe_convention *from, const lmp_probe_convention *to,
                       const float *sh, float *converted) {
    assert(lmpi_is_bands(bands));
    assert(lmpi_are_apart(sh, LMP_SH_COUNT(bands), converted, LMP_SH_COUNT(bands)));
    int a[3][3], b[3][3], change[3][3] = { { 0 } }; /* the change has from's axes by to's */
    axes_of(from, a);
    axes_of(to, b);
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++)
            for (int k = 0; k < 3; k++)
                change[row][column] += a[row][k] * b[column][k];
    assert(determinant(change) != 0);
    for (int l = 0; l < bands; l++)
        scale_band(l, 1 / factor(from, l), odd_sign(from), sh, converted);
    change_axes(bands, change, converted);
    for (int l = 0; l < bands; l++)
        scale_band(l, factor(to, l), odd_sign(to), converted, converted);
}

static bool agrees(int bands, const lmp_probe_convention *convention, const float *ours,
                   const float *theirs, float tolerance) {
    double largest = 0;
    /* Without fmax, because gcc 12 for AArch64 fails on the vectors that it makes of it. */
    for (size_t i = 0; i < LMP_SH_COUNT(bands); i++) {
        const double size = fabs((double)theirs[i]);
        largest = size > largest ? size : largest;
    }
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++) {
            const size_t i = LMP_SH_INDEX(l, m);
            const double sign = m % 2 != 0 ? odd_sign(convention) : 1;
            const double error = (double)theirs[i] - sign * factor(convention, l) * (double)ours[i];
            if (!(fabs(error) <= (double)tolerance * largest))
                return false;
        }
    return true;
}

/* Finds sign and normalization that turn ours into theirs, where the axes agree. */
static bool recognize_basis(int bands, const float *ours, const float *theirs, float tolerance,
                            lmp_probe_convention *guess) {
    for (int sign = 0; sign <= LMP_PROBE_SIGN_POSITIVE; sign++)
        for (int norm = 0; norm <= LMP_PROBE_SN3D; norm++) {
            guess->sign = (lmp_probe_sign)sign;
            guess->normalization = (lmp_probe_normalization)norm;
            if (agrees(bands, guess, ours, theirs, tolerance))
                return true;
        }
    return false;
}

/* Returns axes number 0 … 47; the library's own come first. */
static lmp_probe_convention axes_number(int number) {
    static const signed char orders[6][3] = { { 1, 2, 3 }, { 1, 3, 2 }, { 2, 1, 3 },
                                              { 2, 3, 1 }, { 3, 1, 2 }, { 3, 2, 1 } };
    lmp_probe_convention convention = { 0 };
    for (int i = 0; i < 3; i++) {
        const signed char axis = orders[number / 8][i];
        convention.axes[i] = (signed char)(number >> i & 1 ? -axis : axis);
    }
    return convention;
}

bool lmp_probe_recognize(int bands, float tolerance, const float *ours, const float *theirs,
                         lmp_probe_convention *convention) {
    assert(lmpi_is_bands(bands) && tolerance >= 0);
    const lmp_probe_convention own = { 0 };
    float moved[LMP_SH_COUNT(LMP_PROBE_AXES_BANDS_MAX)];
    lmp_probe_convention guess = own;
    bool found = recognize_basis(bands, ours, theirs, tolerance, &guess);
    for (int i = 1; !found && i < 48 && bands <= LMP_PROBE_AXES_BANDS_MAX; i++) {
        guess = axes_number(i);
        lmp_probe_convert(bands, &own, &guess, ours, moved);
        found = recognize_basis(bands, moved, theirs, tolerance, &guess);
    }
    if (found)
        *convention = guess;
    return found;
}
