/* SPDX-License-Identifier: MIT */
/* double.c - a sphere light in double: lmp_sphere_project without the tables of floats. */
#include "src/base/precondition.h"

#include <lampion/sphere.h>

#include <math.h>
#include <stdbool.h>

/* Computes factors[l] = pi sin²a R_l (sphere.h), as src/sphere/sphere.c does in float. */
static void cap_factors(int bands, double radius, double distance, double *factors) {
    static const double pi = 3.14159265358979323846;
    const bool inside = distance < radius;
    const double near = inside ? distance : radius, far = inside ? radius : distance;
    const double ratio = far == 0 ? 0 : near / far, sin2 = ratio * ratio;
    /* not sqrt(1 - sin²a), which cancels for touching lights */
    const double cosine = far == 0 ? 1 : sqrt((far - near) / far * ((far + near) / far));
    const double one_minus_cos = sin2 / (1 + cosine);
    double difference = 0, polynomial = 1; /* the difference form of R_l (tables.h) */
    factors[0] = 2 * pi * (inside ? 1 + cosine : one_minus_cos);
    for (int l = 1; l < bands; l++) {
        if (l > 1)
            difference =
                ((l - 2) * difference - (2 * l - 1) * one_minus_cos * polynomial) / (l + 1);
        polynomial += difference;
        factors[l] = (inside && l % 2 == 0 ? -pi : pi) * sin2 * polynomial;
    }
}

void lmp_sphere_project_double(int bands, const double center[3], double radius,
                               const double point[3], double *sh) {
    assert(lmpi_is_bands(bands) && radius >= 0 && isfinite(radius));
    assert(isfinite(center[0] + center[1] + center[2] + point[0] + point[1] + point[2]));
    const double v[3] = { center[0] - point[0], center[1] - point[1], center[2] - point[2] };
    const double distance = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    double axis[3] = { 0, 0, 1 }, factors[LMP_BANDS_MAX];
    for (int i = 0; distance != 0 && i < 3; i++)
        axis[i] = v[i] / distance;
    cap_factors(bands, radius, distance, factors);
    lmp_sh_eval_double(bands, axis, sh);
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            sh[LMP_SH_INDEX(l, m)] *= factors[l];
}
