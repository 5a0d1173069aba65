/* SPDX-License-Identifier: MIT */
#include "tests/oracle/sheen.h"
#include "tests/oracle/oracle.h"

#include <math.h>

static double mix(double x, double y, double a) {
    return x * (1 - a) + y * a;
}

static double l(double x, double alpha_g) {
    const double one_minus_alpha_sq = (1.0 - alpha_g) * (1.0 - alpha_g);
    const double a = mix(21.5473, 25.3245, one_minus_alpha_sq);
    const double b = mix(3.82987, 3.32435, one_minus_alpha_sq);
    const double c = mix(0.19823, 0.16801, one_minus_alpha_sq);
    const double d = mix(-1.97760, -1.27393, one_minus_alpha_sq);
    const double e = mix(-4.32054, -4.85967, one_minus_alpha_sq);
    return a / (1.0 + b * pow(x, c)) + d * x + e;
}

static double lambda_sheen(double cos_theta, double alpha_g) {
    return cos_theta < 0.5 ? exp(l(cos_theta, alpha_g))
                           : exp(2.0 * l(0.5, alpha_g) - l(1.0 - cos_theta, alpha_g));
}

/* Clamps a cosine: below, the fit of the masking has no meaning. */
static double held(double cosine) {
    return fmax(cosine, 1e-4);
}

static double lambdas(double alpha_g, const double light[3], const double view[3]) {
    return lambda_sheen(held(view[2]), alpha_g) + lambda_sheen(held(light[2]), alpha_g);
}

double oracle_sheen_unlimited(double roughness, const double light[3], const double view[3]) {
    const double alpha_g = roughness * roughness, inv_r = 1 / alpha_g;
    const double h[3] = { light[0] + view[0], light[1] + view[1], light[2] + view[2] };
    const double cos2h = h[2] * h[2] / (h[0] * h[0] + h[1] * h[1] + h[2] * h[2]);
    const double distribution =
        (2 + inv_r) * pow(fmax(1 - cos2h, 0), inv_r * 0.5) / (2 * ORACLE_PI);
    const double smith = 1.0 + lambdas(alpha_g, light, view);
    return distribution / (smith * 4.0 * held(view[2]) * held(light[2]));
}

/* --- what arrives ----------------------------------------------------------------------------- */

/* Integrates by Gauss-Legendre in the cube root of the light's cosine and the square root of its
 * azimuth. */
static double unlimited_albedo(double roughness, double cosine) {
    enum { NODES = 48 };
    static double node[NODES], weight[NODES];
    const double view[3] = { sqrt(1 - cosine * cosine), 0, cosine };
    double sum = 0;
    if (node[0] == node[1])
        oracle_gauss_legendre(NODES, node, weight);
    for (int i = 0; i < NODES; i++)
        for (int k = 0; k < NODES; k++) {
            const double root = (1 + node[i]) / 2, z = root * root * root, s = sqrt(1 - z * z);
            const double across = (1 + node[k]) / 2, phi = ORACLE_PI * across * across;
            const double light[3] = { s * cos(phi), s * sin(phi), z };
            sum += weight[i] * weight[k] * 3 * root * root * across * z *
                   oracle_sheen_unlimited(roughness, light, view);
        }
    return sum * ORACLE_PI;
}

enum { KEPT = 100 };

/* Returns the gain; values are kept for one roughness. */
double oracle_sheen_gain(double roughness, double cosine) {
    static double last, kept[KEPT + 1];
    const double least = log(1e-4), at = (log(held(cosine)) / least) * KEPT;
    if (last != roughness)
        for (int i = 0; i <= KEPT; i++)
            kept[i] = unlimited_albedo(roughness, exp(least * i / KEPT));
    last = roughness;
    const int i = at < KEPT ? (int)at : KEPT - 1;
    return kept[i] + (kept[i + 1] - kept[i]) * (at - i);
}

double oracle_sheen(double roughness, const double light[3], const double view[3]) {
    const double most =
        fmax(oracle_sheen_gain(roughness, light[2]), oracle_sheen_gain(roughness, view[2]));
    return oracle_sheen_unlimited(roughness, light, view) / fmax(most, 1);
}

/* --- integrals -------------------------------------------------------------------------------- */

/* Returns what a ring of polar angle acos(z) around a direction `to` from the normal gives, of
 * weight 1. */
static double ring(double roughness, const double view[3], double to, double z, int azimuths) {
    const double s = sqrt(1 - z * z);
    double sum = 0;
    for (int k = 0; k < azimuths; k++) {
        const double phi = 2 * ORACLE_PI * (k + 0.5) / azimuths;
        const double light[3] = { cos(to) * s * cos(phi) + sin(to) * z, s * sin(phi),
                                  cos(to) * z - sin(to) * s * cos(phi) };
        if (light[2] > 0)
            sum += light[2] * oracle_sheen(roughness, light, view);
    }
    return sum * 2 * ORACLE_PI / azimuths;
}

/* Integrates E over rings that are dense at the horizon. */
double oracle_sheen_albedo(double roughness, double angle) {
    enum { RINGS = 120, AZIMUTHS = 400 };
    static double node[RINGS], weight[RINGS];
    const double view[3] = { sin(angle), 0, cos(angle) };
    double sum = 0;
    oracle_gauss_legendre(RINGS, node, weight);
    for (int i = 0; i < RINGS; i++) {
        const double root = (1 + node[i]) / 2;
        sum += weight[i] * root * ring(roughness, view, 0, root * root, AZIMUTHS);
    }
    return sum;
}

/* Integrates what a cap of radiance 1 above the horizon gives white sheen. */
double oracle_sheen_cap(double roughness, double to, double half_angle, double angle) {
    enum { RINGS = 24, AZIMUTHS = 48 };
    static double node[RINGS], weight[RINGS];
    const double view[3] = { sin(angle), 0, cos(angle) }, height = 1 - cos(half_angle);
    double sum = 0;
    oracle_gauss_legendre(RINGS, node, weight);
    for (int i = 0; i < RINGS; i++) {
        const double z = 1 - height * (1 + node[i]) / 2;
        sum += weight[i] * height / 2 * ring(roughness, view, to, z, AZIMUTHS);
    }
    return sum;
}
