/* SPDX-License-Identifier: MIT */
/* double.c - the basis in double. Its recurrences are those of tables.h, whose floats would spoil
 * it: factors are computed where they are used, by roots and quotients that IEEE 754 rounds alike
 * on every machine. */
#include "src/base/precondition.h"
#include "src/sh/column.h"

#include <lampion/sh.h>

#include <math.h>

static const double pi = 3.14159265358979323846;

/* Computes q[l] = q_l^m(z) for l = m … bands-1, from q_m^m = first. */
static void column(int bands, int m, double z, double first, double *q) {
    const double mm = (double)m * m;
    double root = 0; /* sqrt(((l-1)² - m²) / (4 (l-1)² - 1)) */
    q[m] = first;
    for (int l = m + 1; l < bands; l++) {
        const double next = sqrt(((double)l * l - mm) / (4.0 * l * l - 1));
        const double before = l > m + 1 ? root * q[l - 2] : 0;
        q[l] = (z * q[l - 1] - before) / next;
        root = next;
    }
}

/* Returns the factor of dq_l^m/dz = factor q_l^(m+1). */
static double slope_factor(int l, int m) {
    return -sqrt((l - m) * (l + m + 1.0) * (m == 0 ? 0.5 : 1));
}

/* Stores the tangent part of a polynomial's derivative g at the direction w. */
static void store_gradient(const double w[3], const double g[3], size_t plane, double *gradient) {
    const double along = g[0] * w[0] + g[1] * w[1] + g[2] * w[2];
    for (size_t i = 0; i < 3; i++)
        gradient[i * plane] = g[i] - along * w[i];
}

void lmp_sh_eval_gradient_double(int bands, const double direction[3], double *sh,
                                 double *gradient) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit_double(direction));
    assert(!gradient || lmpi_are_bytes_apart(sh, LMP_SH_COUNT(bands) * sizeof *sh, gradient,
                                             3 * LMP_SH_COUNT(bands) * sizeof *gradient));
    const double *w = direction;
    const size_t plane = LMP_SH_COUNT(bands);
    double columns[2][LMP_BANDS_MAX + 1] = { { 0 } }, first = sqrt(1 / (4 * pi));
    double c = 1, s = 0, c_below = 0, s_below = 0; /* (x + iy)^m and (x + iy)^(m-1) */
    column(bands, 0, w[2], first, columns[0]);
    for (int m = 0; m < bands; m++) {
        const double *q = columns[m % 2];
        double *above = columns[(m + 1) % 2]; /* q_l^(m+1), 0 at l = m */
        first = lmpi_sh_next_diagonal(m, first);
        if (m + 1 < bands)
            column(bands, m + 1, w[2], first, above);
        above[m] = 0;
        for (int l = m; l < bands; l++) {
            const size_t minus = LMP_SH_INDEX(l, -m), plus = LMP_SH_INDEX(l, m);
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            sh[minus] = q[l] * s;
            sh[plus] = q[l] * c;
            if (!gradient)
                continue;
            const double slope = slope_factor(l, m) * above[l], side = m * q[l];
            const double sine[3] = { side * s_below, side * c_below, slope * s };
            const double cosine[3] = { side * c_below, -side * s_below, slope * c };
            store_gradient(w, sine, plane, gradient + minus);
            store_gradient(w, cosine, plane, gradient + plus);
        }
        c_below = c, s_below = s;
        c = w[0] * c_below - w[1] * s_below;
        s = w[0] * s_below + w[1] * c_below;
    }
}

void lmp_sh_eval_double(int bands, const double direction[3], double *sh) {
    lmp_sh_eval_gradient_double(bands, direction, sh, NULL);
}

/* --- second derivatives ----------------------------------------------------------------------- */

/* The first and second derivatives of the polynomial p = q_l^m(z) {C_m, S_m}, which one coefficient
 * needs. */
typedef struct slopes {
    double first[3];     /* x, y, z */
    double second[3][3]; /* symmetric */
} slopes;

/* Stores the second derivatives of p(v / |v|) at the unit vector w: with P = 1 - w w^T and g' = P
 * g, they are P H P - (g·w) P - g' w^T - w g'^T. */
static void store_hessian(const double w[3], const slopes *p, size_t plane, double *hessian) {
    const double *g = p->first;
    const double along = g[0] * w[0] + g[1] * w[1] + g[2] * w[2];
    double hw[3], whw = 0;
    for (int i = 0; i < 3; i++)
        hw[i] = p->second[i][0] * w[0] + p->second[i][1] * w[1] + p->second[i][2] * w[2];
    for (int i = 0; i < 3; i++)
        whw += w[i] * hw[i];
    for (int i = 0; i < 3; i++)
        for (int j = i; j < 3; j++) {
            const double tangent = p->second[i][j] - w[i] * hw[j] - hw[i] * w[j];
            const double crossed = (g[i] - along * w[i]) * w[j] + w[i] * (g[j] - along * w[j]);
            *hessian = tangent + whw * w[i] * w[j] - along * ((i == j) - w[i] * w[j]) - crossed;
            hessian += plane;
        }
}

/* Computes the derivatives of the polynomial q(z) A(x, y), A harmonic: A_yy = -A_xx. q holds its
 * first two derivatives too. */
static slopes slopes_of(const double q[3], double a, double a_x, double a_y, double a_xx,
                        double a_xy) {
    return (slopes) { { q[0] * a_x, q[0] * a_y, q[1] * a },
                      { { q[0] * a_xx, q[0] * a_xy, q[1] * a_x },
                        { q[0] * a_xy, -q[0] * a_xx, q[1] * a_y },
                        { q[1] * a_x, q[1] * a_y, q[2] * a } } };
}

void lmp_sh_eval_hessian_double(int bands, const double direction[3], double *hessian) {
    assert(lmpi_is_bands(bands) && lmpi_is_unit_double(direction));
    const double *w = direction;
    const size_t plane = LMP_SH_COUNT(bands);
    double columns[3][LMP_BANDS_MAX] = { { 0 } }, first = sqrt(1 / (4 * pi));
    double c[3] = { 1, 0, 0 }, s[3] = { 0, 0, 0 }; /* (x + iy)^m, (x + iy)^(m-1), (x + iy)^(m-2) */
    column(bands, 0, w[2], first, columns[0]);
    first = lmpi_sh_next_diagonal(0, first);
    if (bands > 1)
        column(bands, 1, w[2], first, columns[1]);
    for (int m = 0; m < bands; m++) {
        const double *q = columns[m % 3], *above = columns[(m + 1) % 3];
        double *twice = columns[(m + 2) % 3];
        first = lmpi_sh_next_diagonal(m + 1, first);
        if (m + 2 < bands)
            column(bands, m + 2, w[2], first, twice);
        const double one = m, two = (double)m * (m - 1);
        for (int l = m; l < bands; l++) {
            const double dz = l > m ? slope_factor(l, m) : 0;
            const double dzz = l > m + 1 ? dz * slope_factor(l, m + 1) : 0;
            const double z[3] = { q[l], dz != 0 ? dz * above[l] : 0,
                                  dzz != 0 ? dzz * twice[l] : 0 };
            const slopes sine = slopes_of(z, s[0], one * s[1], one * c[1], two * s[2], two * c[2]);
            const slopes cosine =
                slopes_of(z, c[0], one * c[1], -one * s[1], two * c[2], -two * s[2]);
            /* -m first: at m = 0 both are one coefficient, and cosine wins */
            store_hessian(w, &sine, plane, hessian + LMP_SH_INDEX(l, -m));
            store_hessian(w, &cosine, plane, hessian + LMP_SH_INDEX(l, m));
        }
        c[2] = c[1], c[1] = c[0], s[2] = s[1], s[1] = s[0];
        c[0] = w[0] * c[1] - w[1] * s[1];
        s[0] = w[0] * s[1] + w[1] * c[1];
    }
}
