/* SPDX-License-Identifier: MIT */
#include "src/brdf/brdf.h"

#include <math.h>

static bool all_within(const double *values, int count, double minimum, double maximum) {
    for (int k = 0; k < count; k++)
        if (!(values[k] >= minimum && values[k] <= maximum))
            return false;
    return true;
}

/* Copies a color; returns false unless it is finite and not negative. */
static bool take_color(lmp_rgb rgb, double out[3]) {
    out[0] = (double)rgb.r;
    out[1] = (double)rgb.g;
    out[2] = (double)rgb.b;
    return all_within(out, 3, 0, 3e38);
}

/* --- Lambert ---------------------------------------------------------------------------------- */

static void eval_lambert(const lmp_brdf *brdf, const double a[3], const double b[3],
                         double rgb[3]) {
    (void)a;
    (void)b;
    for (int c = 0; c < 3; c++)
        rgb[c] = brdf->lambert[c] / BRDF_PI;
}

lmp_result lmp_brdf_create_lambert(const lmp_host *host, lmp_rgb albedo, lmp_brdf **brdf) {
    *brdf = NULL;
    double color[3];
    if (!take_color(albedo, color))
        return LMP_ERROR_ARGUMENT;
    const lmp_result result = lmpi_brdf_new(host, LMP_BRDF_LAMBERT, 0, brdf);
    if (result != LMP_OK)
        return result;
    memcpy((*brdf)->lambert, color, sizeof color);
    (*brdf)->info.mirrored = true;
    (*brdf)->eval = eval_lambert;
    return LMP_OK;
}

/* --- Phong ------------------------------------------------------------------------------------ */

static void eval_phong(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    const double e = brdf->phong.exponent;
    const double t = a[2] * b[2] - a[0] * b[0] - a[1] * b[1];
    const double lobe = t > 0 ? (e + 2) / (2 * BRDF_PI) * pow(t, e) : 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = brdf->phong.reflectance[c] * lobe;
}

lmp_result lmp_brdf_create_phong(const lmp_host *host, lmp_rgb reflectance, float exponent,
                                 lmp_brdf **brdf) {
    *brdf = NULL;
    brdf_phong phong = { .exponent = (double)exponent };
    if (!take_color(reflectance, phong.reflectance) || !all_within(&phong.exponent, 1, 0, 1e6))
        return LMP_ERROR_ARGUMENT;
    const lmp_result result = lmpi_brdf_new(host, LMP_BRDF_PHONG, 0, brdf);
    if (result != LMP_OK)
        return result;
    (*brdf)->phong = phong;
    (*brdf)->info.mirrored = true;
    (*brdf)->eval = eval_phong;
    return LMP_OK;
}

/* --- GGX -------------------------------------------------------------------------------------- */

/* Computes w.z (1 + 2 Λ), where Smith's Λ for GGX is the masking of direction w. */
static double smith_root(const brdf_ggx *ggx, const double w[3]) {
    const double x = ggx->alpha_x * w[0], y = ggx->alpha_y * w[1];
    return sqrt(w[2] * w[2] + x * x + y * y);
}

static void eval_ggx(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    const brdf_ggx *ggx = &brdf->ggx;
    double h[3];
    lmpi_brdf_half_vector(a, b, h);
    const double x = h[0] / ggx->alpha_x, y = h[1] / ggx->alpha_y, s = x * x + y * y + h[2] * h[2];
    const double d = 1 / (BRDF_PI * ggx->alpha_x * ggx->alpha_y * s * s);
    /* 1 / (1 + Λ(a) + Λ(b)) / (4 a.z b.z), which goes to infinity at the horizon */
    const double g = 0.5 / fmax(a[2] * smith_root(ggx, b) + b[2] * smith_root(ggx, a), 1e-290);
    const double u = fmax(0, 1 - brdf_dot(a, h)), u5 = u * u * u * u * u;
    for (int c = 0; c < 3; c++) {
        const double f = ggx->f0[c] + (1 - ggx->f0[c]) * u5;
        rgb[c] = (1 - f) * ggx->diffuse[c] / BRDF_PI + f * d * g;
    }
}

lmp_result lmp_brdf_create_ggx(const lmp_host *host, const lmp_ggx *ggx, lmp_brdf **brdf) {
    *brdf = NULL;
    brdf_ggx own = { .alpha_x = (double)ggx->alpha_x, .alpha_y = (double)ggx->alpha_y };
    if (ggx->alpha_y == 0)
        own.alpha_y = own.alpha_x;
    if (!all_within(&own.alpha_x, 1, 0.00099, 1) || !all_within(&own.alpha_y, 1, 0.00099, 1) ||
        !take_color(ggx->f0, own.f0) || !take_color(ggx->diffuse, own.diffuse) ||
        !all_within(own.f0, 3, 0, 1))
        return LMP_ERROR_ARGUMENT;
    const lmp_result result = lmpi_brdf_new(host, LMP_BRDF_GGX, 0, brdf);
    if (result != LMP_OK)
        return result;
    (*brdf)->ggx = own;
    (*brdf)->info.anisotropic = ggx->alpha_y != 0 && ggx->alpha_y != ggx->alpha_x;
    (*brdf)->info.mirrored = !(*brdf)->info.anisotropic;
    (*brdf)->eval = eval_ggx;
    return LMP_OK;
}
