/* SPDX-License-Identifier: MIT */
/* sheen.c - cloth as KHR_materials_sheen has it: fibers that stand on a diffuse base, by the
 * distribution and the masking of Conty Estevez and Kulla (2017), limited to the light that
 * arrives, and what they leave of the base. */
#include "src/brdf/brdf.h"
#include "src/sh/quadrature.h"

#include <math.h>

/* --- the sheen -------------------------------------------------------------------------------- */

/* A fit of the logarithm of the masking by its authors, over a cosine; the rows are for alpha 0 and
 * 1. */
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

/* Clamps a cosine to where the fit of the masking is valid: nearer to the horizon the quotient by
 * the cosine grows without bound. */
static double held_cosine(double cosine) {
    return fmax(cosine, 1e-4);
}

/* Returns the distribution of half vectors where their sine is 1. */
static double normal_scale(double alpha) {
    return (2 + 1 / alpha) / (2 * BRDF_PI);
}

/* Computes f_r of white sheen by the specification, times a cosine a.z, which keeps it finite at
 * a's horizon; `masked` is the sum of the maskings of both directions. */
static double sheen_cosine(double alpha, double masked, const double a[3], const double b[3]) {
    double h[3];
    lmpi_brdf_half_vector(a, b, h);
    const double square = fmax(1 - h[2] * h[2], 0);
    return normal_scale(alpha) * pow(square, 0.5 / alpha) / ((1 + masked) * 4 * held_cosine(b[2]));
}

/* --- what they reflect ------------------------------------------------------------------------ */

enum { NODES = BRDF_SHEEN_ALBEDOS };

/* Interpolates between nodes, which lie evenly in the square root of the cosine, because sheen
 * change fastest toward the horizon. */
static double between_nodes(const double values[NODES], double cosine) {
    const double at = sqrt(fmin(cosine, 1)) * (NODES - 1);
    const int i = at < NODES - 2 ? (int)at : NODES - 2;
    return values[i] + (values[i + 1] - values[i]) * (at - i);
}

static double gain_of(const brdf_sheen *sheen, double a, double b) {
    return fmax(fmax(between_nodes(sheen->gain, a), between_nodes(sheen->gain, b)), 1);
}

/* A uniform sky over sheen, by Gauss's nodes in the square root of the light's cosine and in that
 * of its azimuth from the view: both are dense toward the horizon, where sheen is bright. Light on
 * the far side of the view counts as light on its own side. */
enum { RINGS = 48 };
typedef struct sky {
    double z[RINGS], radius[RINGS], masked[RINGS], weight[RINGS];
    double azimuth_cosine[RINGS], azimuth_weight[RINGS];
} sky;

static void sky_prepare(sky *over, double alpha) {
    for (int i = 0; i < RINGS; i++) {
        double node, weight;
        lmpi_gauss_legendre(RINGS, i, &node, &weight);
        const double root = (1 + node) / 2, z = root * root;
        over->z[i] = z;
        over->radius[i] = sqrt(1 - z * z);
        over->masked[i] = masking(held_cosine(z), alpha);
        over->weight[i] = weight * root * 2 * BRDF_PI;
        over->azimuth_cosine[i] = cos(BRDF_PI * z);
        over->azimuth_weight[i] = weight * root;
    }
}

/* Computes what sheen reflects of each ring before it is divided by its gain. The half
 * vector's height comes from the cosine between light and view. */
static void reflect_rings(const sky *over, double alpha, double cosine, double rings[RINGS]) {
    const double side = sqrt(1 - cosine * cosine), power = 0.5 / alpha;
    const double masked = masking(held_cosine(cosine), alpha);
    for (int i = 0; i < RINGS; i++) {
        const double up = over->z[i] + cosine, up2 = up * up;
        const double along = 1 + over->z[i] * cosine, across = over->radius[i] * side;
        double sum = 0;
        for (int k = 0; k < RINGS; k++) {
            const double length2 = 2 * (along + across * over->azimuth_cosine[k]);
            const double square = length2 > up2 ? 1 - up2 / length2 : 0;
            sum += over->azimuth_weight[k] * pow(square, power);
        }
        rings[i] = over->weight[i] * sum * normal_scale(alpha) /
                   ((1 + masked + over->masked[i]) * 4 * held_cosine(cosine));
    }
}

/* Fills the albedos of a sheen whose gain is known. */
static void fill_albedos(const sky *over, double (*rings)[RINGS], brdf_sheen *sheen) {
    for (int i = 0; i < NODES; i++) {
        const double root = (double)i / (NODES - 1);
        sheen->albedo[i] = 0;
        for (int k = 0; k < RINGS; k++)
            sheen->albedo[i] += rings[i][k] / gain_of(sheen, over->z[k], root * root);
    }
}

/* Limits the gain: by the specification's masking, smooth sheen reflects up to three times what
 * arrives. Divided by the larger of the albedos toward a and b, where it exceeds 1, they reflect no
 * more than arrives and remain reciprocal. */
static lmp_result limit_gain(const lmp_host *host, brdf_sheen *sheen) {
    const double between = 1.003; /* the gain between two nodes is larger by less */
    double largest = 0, (*rings)[RINGS] = lmpi_allocate(host, NODES * sizeof *rings);
    sky over;
    if (!rings)
        return LMP_ERROR_MEMORY;
    sky_prepare(&over, sheen->alpha);
    for (int i = 0; i < NODES; i++) {
        const double root = (double)i / (NODES - 1);
        reflect_rings(&over, sheen->alpha, root * root, rings[i]);
    }
    memset(sheen->gain, 0, sizeof sheen->gain);
    fill_albedos(&over, rings, sheen);
    for (int i = 0; i < NODES; i++)
        largest = fmax(largest, between * sheen->albedo[i]);
    if (largest > 1) {
        for (int i = 0; i < NODES; i++)
            sheen->gain[i] = between * sheen->albedo[i];
        fill_albedos(&over, rings, sheen);
    }
    lmpi_release(host, rings);
    return LMP_OK;
}

static void eval_sheen(const lmp_brdf *brdf, const double a[3], const double b[3], double rgb[3]) {
    const brdf_sheen *sheen = &brdf->sheen;
    const double la = held_cosine(a[2]), lb = held_cosine(b[2]);
    const double masked = masking(la, sheen->alpha) + masking(lb, sheen->alpha);
    const double white =
        sheen_cosine(sheen->alpha, masked, a, b) / (la * gain_of(sheen, a[2], b[2]));
    const double held =
        fmax(between_nodes(sheen->albedo, a[2]), between_nodes(sheen->albedo, b[2]));
    const double most = fmax(sheen->color[0], fmax(sheen->color[1], sheen->color[2]));
    const double passed = fmax(1 - most * held, 0);
    for (int c = 0; c < 3; c++)
        rgb[c] = sheen->color[c] * white + passed * sheen->diffuse[c] / BRDF_PI;
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
    const lmp_result result = lmpi_brdf_new(host, LMP_BRDF_SHEEN, 0, brdf);
    if (result != LMP_OK)
        return result;
    const lmp_result limited = limit_gain(&(*brdf)->host, &own);
    if (limited != LMP_OK) {
        lmp_brdf_destroy(*brdf);
        *brdf = NULL;
        return limited;
    }
    (*brdf)->sheen = own;
    (*brdf)->info.mirrored = true;
    (*brdf)->eval = eval_sheen;
    return LMP_OK;
}
