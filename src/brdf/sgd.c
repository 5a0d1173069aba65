/* SPDX-License-Identifier: MIT */
#include "src/brdf/brdf.h"
#include "src/brdf/sgd_table.h"

#include <math.h>

/* The exponential of anything larger overflows a double. */
#define EXPONENT_MAX 700.0
/* A bound below which the values of any fit, and their sums, stay finite as floats. */
#define VALUE_MAX 1e30

/* Computes P22(tan² theta_h) / (pi cos⁴ theta_h), with P22(x) = K exp(-s) s^-p, s = alpha +
 * x/alpha. */
static double distribution(const lmp_sgd *sgd, int c, double cos_h) {
    const double cos2 = cos_h * cos_h, tan2 = (1 - cos2) / cos2;
    const double s = sgd->alpha[c] + fmax(tan2, 0) / sgd->alpha[c];
    if (!(s < EXPONENT_MAX))
        return 0;
    return sgd->k_ap[c] * exp(-s - sgd->p[c] * log(s)) / (BRDF_PI * cos2 * cos2);
}

/* Computes clamp(1 + lambda (1 - exp(c t^k)), 0, 1), with t = theta - theta0. k reaches 856 and c
 * 1e38, so only their product is meaningful: it is formed in logarithms and clamped below overflow.
 */
static double shadowing(const lmp_sgd *sgd, int c, double theta) {
    const double t = theta - sgd->theta0[c];
    const double power = t > 0 ? exp(fmin(sgd->k[c] * log(t), EXPONENT_MAX - 90)) : 0;
    const double fall = exp(fmin(sgd->c[c] * power, EXPONENT_MAX));
    return fmin(fmax(1 + sgd->lambda[c] * (1 - fall), 0), 1);
}

static void eval_sgd(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    const lmp_sgd *sgd = &brdf->sgd;
    double h[3];
    lmpi_brdf_half_vector(a, b, h);
    const double cos_d = brdf_dot(a, h), u = 1 - cos_d, u5 = u * u * u * u * u;
    const double theta_a = acos(fmin(a[2], 1)), theta_b = acos(fmin(b[2], 1));
    for (int c = 0; c < 3; c++) {
        const double f = sgd->f0[c] - sgd->f1[c] * cos_d + (1 - sgd->f0[c]) * u5;
        const double g = shadowing(sgd, c, theta_a) * shadowing(sgd, c, theta_b);
        const double lobe = distribution(sgd, c, h[2]) * f * g / (a[2] * b[2]);
        rgb[c] = fmin(fmax(0, (sgd->rho_d[c] + sgd->rho_s[c] * lobe) / BRDF_PI), VALUE_MAX);
    }
}

static bool is_valid(const lmp_sgd *sgd) {
    const double *const parameters[] = { sgd->rho_d, sgd->rho_s, sgd->alpha, sgd->p,
                                         sgd->f0,    sgd->f1,    sgd->k_ap,  sgd->lambda,
                                         sgd->c,     sgd->k,     sgd->theta0 };
    for (size_t i = 0; i < sizeof parameters / sizeof *parameters; i++)
        for (int c = 0; c < 3; c++)
            if (!(fabs(parameters[i][c]) <= 1e39))
                return false;
    for (int c = 0; c < 3; c++)
        if (!(sgd->alpha[c] >= 1e-9 && sgd->k[c] >= 0))
            return false;
    return true;
}

lmp_result lmp_brdf_create_sgd(const lmp_host *host, const lmp_sgd *sgd, lmp_brdf **brdf) {
    *brdf = NULL;
    if (!is_valid(sgd))
        return LMP_ERROR_ARGUMENT;
    const lmp_result result = lmpi_brdf_new(host, LMP_BRDF_SGD, 0, brdf);
    if (result != LMP_OK)
        return result;
    (*brdf)->sgd = *sgd;
    (*brdf)->info.mirrored = true;
    (*brdf)->eval = eval_sgd;
    return LMP_OK;
}

const char *lmp_brdf_sgd_name(size_t index) {
    return index < lmpi_sgd_row_count ? lmpi_sgd_rows[index].name : NULL;
}

lmp_result lmp_brdf_find_sgd(const char *name, lmp_sgd *sgd) {
    for (size_t i = 0; *name && i < lmpi_sgd_row_count; i++) {
        const brdf_sgd_row *row = &lmpi_sgd_rows[i];
        if (strcmp(name, row->name) == 0 || strcmp(name, row->alias) == 0) {
            *sgd = row->sgd;
            return LMP_OK;
        }
    }
    return LMP_ERROR_ARGUMENT;
}
