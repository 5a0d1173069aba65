/* SPDX-License-Identifier: MIT */
/* sheen.c - cloth as KHR_materials_sheen has it: fibers that stand on a diffuse base, by the
 * distribution and the masking of Conty Estevez and Kulla (2017), and what they leave of the base.
 */
#include "src/brdf/brdf.h"
#include "src/sh/quadrature.h"

#include <math.h>

/* --- the fibers ------------------------------------------------------------------------------- */

/* A fit of the logarithm of the masking by its authors: of a cosine, by rows for alpha 0 and 1. */
static double masking_log(double cosine, double alpha) {
    static const double rows[2][5] = { { 25.3245, 3.32435, 0.16801, -1.27393, -4.85967 },
                                       { 21.5473, 3.82987, 0.19823, -1.97760, -4.32054 } };
    const double part = (1 - alpha) * (1 - alpha);
    double p[5];
    for (int i = 0; i < 5; i++)
        p[i] = part * rows[0][i] + (1 - part) * rows[1][i];
    return p[0] / (1 + p[1] * pow(cosine, p[2])) + p[3] * cosine + p[4];
}

static double masking(double cosine, double alpha) {
    if (cosine < 0.5)
        return exp(masking_log(cosine, alpha));
    return exp(2 * masking_log(0.5, alpha) - masking_log(fmax(1 - cosine, 0), alpha));
}

/* f_r of white fibers, times a cosine a.z, with which it is finite at a's horizon. */
static double fibers_cosine(double alpha, const double a[3], const double b[3]) {
    double h[3];
    lmp_brdf_half(a, b, h);
    const double square = fmax(1 - h[2] * h[2], 0);
    const double distribution = (2 + 1 / alpha) * pow(square, 0.5 / alpha) / (2 * BRDF_PI);
    return distribution / ((1 + masking(a[2], alpha) + masking(b[2], alpha)) * 4 * b[2]);
}

/* --- the base --------------------------------------------------------------------------------- */

/* What white fibers reflect of a uniform sky. Light on the far side of the view and on its own
 * counts alike; nodes are dense toward the horizon, where they shine. */
static double fibers_albedo(double alpha, double theta) {
    enum { NODES = 48 };
    const double view[3] = { sin(theta), 0, cos(theta) };
    double node[NODES], weight[NODES], sum = 0;
    for (int i = 0; i < NODES; i++)
        lmp_gauss_legendre(NODES, i, &node[i], &weight[i]);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            const double up = (1 + node[i]) / 2, z = up * up, s = sqrt(1 - z * z);
            const double across = (1 + node[k]) / 2, phi = BRDF_PI * across * across;
            const double light[3] = { s * cos(phi), s * sin(phi), z };
            const double solid = weight[i] * up * weight[k] * across * 2 * BRDF_PI;
            sum += solid * fibers_cosine(alpha, light, view);
        }
    return sum;
}

/* Between the nodes of brdf_sheen's table. */
static double albedo_at(const brdf_sheen *sheen, double cosine) {
    const double at = acos(fmin(cosine, 1)) / (0.5 * BRDF_PI) * (BRDF_SHEEN_ALBEDOS - 1);
    const int i = at < BRDF_SHEEN_ALBEDOS - 2 ? (int)at : BRDF_SHEEN_ALBEDOS - 2;
    return sheen->albedo[i] + (sheen->albedo[i + 1] - sheen->albedo[i]) * (at - i);
}

static void eval_sheen(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    const brdf_sheen *sheen = &brdf->sheen;
    const double fibers = fibers_cosine(sheen->alpha, a, b) / a[2];
    const double held = fmax(albedo_at(sheen, a[2]), albedo_at(sheen, b[2]));
    const double most = fmax(sheen->color[0], fmax(sheen->color[1], sheen->color[2]));
    const double passed = fmax(1 - most * held, 0);
    for (int c = 0; c < 3; c++)
        rgb[c] = sheen->color[c] * fibers + passed * sheen->diffuse[c] / BRDF_PI;
}

/* --- making one ------------------------------------------------------------------------------- */

static bool take_color(lmp_rgb rgb, double most, double out[3]) {
    const double own[3] = { (double)rgb.r, (double)rgb.g, (double)rgb.b };
    memcpy(out, own, sizeof own);
    for (int c = 0; c < 3; c++)
        if (!(own[c] >= 0 && own[c] <= most))
            return false;
    return true;
}

lmp_result lmp_brdf_create_sheen(const lmp_host *host, const lmp_sheen *sheen, lmp_brdf **brdf) {
    const double roughness = (double)sheen->roughness;
    brdf_sheen own = { .alpha = roughness * roughness };
    *brdf = NULL;
    if (!(roughness >= 0.0699 && roughness <= 1) || !take_color(sheen->color, 1, own.color) ||
        !take_color(sheen->diffuse, 3e38, own.diffuse))
        return LMP_ERROR_ARGUMENT;
    const lmp_result result = lmp_brdf_new(host, LMP_BRDF_SHEEN, 0, brdf);
    if (result != LMP_OK)
        return result;
    for (int i = 0; i < BRDF_SHEEN_ALBEDOS; i++) /* at the last node just before the horizon */
        own.albedo[i] =
            fibers_albedo(own.alpha, fmin(0.5 * BRDF_PI * i / (BRDF_SHEEN_ALBEDOS - 1), 1.5707));
    (*brdf)->sheen = own;
    (*brdf)->info.mirrored = true;
    (*brdf)->eval = eval_sheen;
    return LMP_OK;
}
