/* SPDX-License-Identifier: MIT */
#include "app/reference/sheen.h"

#define GRAZING 1e-4 /* least cosine of a view */

enum { NODES = REFERENCE_SHEEN_NODES };

/* The fit of the masking's logarithm, as the specification writes it. */
static double masking_log(double x, double alpha) {
    const double t = (1 - alpha) * (1 - alpha);
    const double a = 21.5473 + (25.3245 - 21.5473) * t, b = 3.82987 + (3.32435 - 3.82987) * t;
    const double c = 0.19823 + (0.16801 - 0.19823) * t, d = -1.97760 + (-1.27393 + 1.97760) * t;
    const double e = -4.32054 + (-4.85967 + 4.32054) * t;
    return a / (1 + b * pow(x, c)) + d * x + e;
}

static double masking(double cosine, double alpha) {
    return cosine < 0.5 ? exp(masking_log(cosine, alpha))
                        : exp(2 * masking_log(0.5, alpha) - masking_log(1 - cosine, alpha));
}

/* f_r cos(theta) of white fibers, by the cosines of light, view and half vector. */
static double fibers(double alpha, double light, double view, double half) {
    const double sine2 = fmax(1 - half * half, 0);
    const double d = (2 + 1 / alpha) * pow(sine2, 0.5 / alpha) / (2 * REFERENCE_PI);
    return d / ((1 + masking(light, alpha) + masking(view, alpha)) * 4 * view);
}

static double half_cosine(reference_vec light, reference_vec view, reference_vec normal) {
    const reference_vec h = reference_add(light, view);
    return fmin(fabs(reference_dot(h, normal)) / reference_length(h), 1);
}

/* --- what they leave -------------------------------------------------------------------------- */

/* Midpoints, dense at the horizon and behind the view, where fibers shine. */
static double albedo(double alpha, double cosine) {
    enum { RINGS = 64, AZIMUTHS = 32 };
    const reference_vec up = { 0, 0, 1 }, view = { sqrt(1 - cosine * cosine), 0, cosine };
    double sum = 0;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < AZIMUTHS; k++) {
            const double u = (i + 0.5) / RINGS, z = u * u, s = sqrt(1 - z * z);
            const double across = (k + 0.5) / AZIMUTHS, phi = REFERENCE_PI * across * across;
            const reference_vec light = { s * cos(phi), s * sin(phi), z };
            const double solid = 2 * u / RINGS * 4 * REFERENCE_PI * across / AZIMUTHS;
            sum += solid * fibers(alpha, z, cosine, half_cosine(light, view, up));
        }
    return sum;
}

void reference_sheen_albedos_fill(reference_sheen_albedos *albedos) {
    const double least = REFERENCE_SHEEN_ROUGHNESS_MIN;
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < NODES; r++)
        for (int v = 0; v < NODES; v++) {
            const double rough = least + (1 - least) * r / (NODES - 1);
            const double root = (double)v / (NODES - 1);
            albedos->at[r][v] = albedo(rough * rough, fmax(root * root, GRAZING));
        }
}

static double albedo_at(const reference_sheen_albedos *albedos, double roughness, double cosine) {
    const double least = REFERENCE_SHEEN_ROUGHNESS_MIN;
    const double y = (roughness - least) / (1 - least) * (NODES - 1);
    const double x = sqrt(fmin(cosine, 1)) * (NODES - 1);
    const int r = y < NODES - 2 ? (int)y : NODES - 2, v = x < NODES - 2 ? (int)x : NODES - 2;
    const double *low = albedos->at[r] + v, *high = albedos->at[r + 1] + v;
    const double a = low[0] + (low[1] - low[0]) * (x - v);
    const double b = high[0] + (high[1] - high[0]) * (x - v);
    return a + (b - a) * (y - r);
}

/* --- a surface -------------------------------------------------------------------------------- */

void reference_sheen_set(reference_sheen *sheen, const reference_sheen_albedos *albedos,
                         const double color[3], double roughness, reference_vec normal,
                         reference_vec view) {
    const double rough = fmin(fmax(roughness, REFERENCE_SHEEN_ROUGHNESS_MIN), 1);
    const double cosine = fmax(reference_dot(normal, view), GRAZING);
    const double most = fmax(color[0], fmax(color[1], color[2]));
    *sheen = (reference_sheen) { .color = { color[0], color[1], color[2] },
                                 .alpha = rough * rough,
                                 .under = fmax(1 - most * albedo_at(albedos, rough, cosine), 0),
                                 .normal = normal,
                                 .view = view };
}

void reference_sheen_at(const reference_sheen *sheen, reference_vec w, double rgb[3]) {
    const double light = reference_dot(w, sheen->normal);
    const double view = fmax(reference_dot(sheen->view, sheen->normal), GRAZING);
    const double half = half_cosine(w, sheen->view, sheen->normal);
    const double white = light > 0 ? fibers(sheen->alpha, fmin(light, 1), fmin(view, 1), half) : 0;
    for (int c = 0; c < 3; c++)
        rgb[c] = sheen->color[c] * white;
}
