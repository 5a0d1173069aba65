/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_sheen.h"

#define GRAZING 1e-4 /* least cosine of light and view */

enum { ROWS = REFERENCE_SHEEN_ROUGHNESSES, COLUMNS = REFERENCE_SHEEN_COSINES };

/* Evaluates the fit of the masking's logarithm, as in the specification. */
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

/* Evaluates f_r cos(theta) of a white sheen by the cosines of view and half vector and the sum of
 * the maskings of light and view. */
static double white_sheen(double alpha, double masked, double view, double half_cosine) {
    const double sine2 = fmax(1 - half_cosine * half_cosine, 0);
    const double d = (2 + 1 / alpha) * pow(sine2, 0.5 / alpha) / (2 * REFERENCE_PI);
    return d / ((1 + masked) * 4 * view);
}

static double half_vector_cosine(reference_vec light, reference_vec view, reference_vec normal) {
    const reference_vec h = reference_add(light, view);
    return fmin(fabs(reference_dot(h, normal)) / reference_length(h), 1);
}

/* --- what they reflect ------------------------------------------------------------------------ */

static double cosine_of(int column) {
    const double root = (double)column / (COLUMNS - 1);
    return fmax(root * root, GRAZING);
}

static double along_row(const double row[COLUMNS], double cosine) {
    const double x = sqrt(fmin(cosine, 1)) * (COLUMNS - 1);
    const int c = x < COLUMNS - 2 ? (int)x : COLUMNS - 2;
    return row[c] + (row[c + 1] - row[c]) * (x - c);
}

/* Integrates the reflection of a uniform sky, divided by the gain, by midpoints that are dense at
 * the horizon and behind the view, where sheen is brightest. */
static double albedo(double alpha, const double gain[COLUMNS], double cosine) {
    enum { RINGS = 64, AZIMUTHS = 32 };
    const reference_vec up = { 0, 0, 1 }, view = { sqrt(1 - cosine * cosine), 0, cosine };
    const double own = masking(cosine, alpha), most = along_row(gain, cosine);
    double sum = 0;
    for (int i = 0; i < RINGS; i++) {
        const double u = (i + 0.5) / RINGS, z = u * u, s = sqrt(1 - z * z);
        const double masked = own + masking(z, alpha);
        double ring = 0;
        for (int k = 0; k < AZIMUTHS; k++) {
            const double across = (k + 0.5) / AZIMUTHS, phi = REFERENCE_PI * across * across;
            const reference_vec light = { s * cos(phi), s * sin(phi), z };
            ring +=
                across * white_sheen(alpha, masked, cosine, half_vector_cosine(light, view, up));
        }
        sum += u * ring / fmax(fmax(most, along_row(gain, z)), 1);
    }
    return sum * 2 / RINGS * 4 * REFERENCE_PI / AZIMUTHS;
}

/* Computes the albedo of the specification's formulas, which gives the gain, then the albedo with
 * that gain. */
static void fill_row(reference_sheen_albedos *albedos, int r) {
    const double roughness = pow(REFERENCE_SHEEN_ROUGHNESS_MIN, 1 - (double)r / (ROWS - 1));
    double *gain = albedos->gain[r], raw[COLUMNS];
    for (int c = 0; c < COLUMNS; c++)
        gain[c] = 0;
    for (int c = 0; c < COLUMNS; c++)
        raw[c] = albedo(roughness * roughness, gain, cosine_of(c));
    for (int c = 0; c < COLUMNS; c++)
        gain[c] = REFERENCE_SHEEN_MARGIN * raw[c];
    for (int c = 0; c < COLUMNS; c++)
        albedos->at[r][c] = albedo(roughness * roughness, gain, cosine_of(c));
}

void reference_sheen_albedos_fill(reference_sheen_albedos *albedos) {
#pragma omp parallel for schedule(dynamic)
    for (int r = 0; r < ROWS; r++)
        fill_row(albedos, r);
}

static double in_table(const double table[ROWS][COLUMNS], double roughness, double cosine) {
    const double y = (1 - log(roughness) / log(REFERENCE_SHEEN_ROUGHNESS_MIN)) * (ROWS - 1);
    const int r = y < ROWS - 2 ? (int)y : ROWS - 2;
    const double a = along_row(table[r], cosine), b = along_row(table[r + 1], cosine);
    return a + (b - a) * (y - r);
}

/* --- a surface -------------------------------------------------------------------------------- */

void reference_sheen_set(reference_sheen *sheen, const reference_sheen_albedos *albedos,
                         const double color[3], double roughness, reference_vec normal,
                         reference_vec view) {
    const double rough = fmin(fmax(roughness, REFERENCE_SHEEN_ROUGHNESS_MIN), 1);
    const double cosine = fmax(reference_dot(normal, view), GRAZING);
    const double most = fmax(color[0], fmax(color[1], color[2]));
    *sheen = (reference_sheen) { .albedos = albedos,
                                 .color = { color[0], color[1], color[2] },
                                 .roughness = rough,
                                 .gain = in_table(albedos->gain, rough, cosine),
                                 .under = fmax(1 - most * in_table(albedos->at, rough, cosine), 0),
                                 .normal = normal,
                                 .view = view };
}

void reference_sheen_at(const reference_sheen *sheen, reference_vec w, double rgb[3]) {
    const double alpha = sheen->roughness * sheen->roughness;
    const double light = fmin(reference_dot(w, sheen->normal), 1);
    const double view = fmin(fmax(reference_dot(sheen->view, sheen->normal), GRAZING), 1);
    double white = 0;
    if (light > 0) {
        const double masked = masking(fmax(light, GRAZING), alpha) + masking(view, alpha);
        const double half_cosine = half_vector_cosine(w, sheen->view, sheen->normal);
        const double gain = in_table(sheen->albedos->gain, sheen->roughness, light);
        white = white_sheen(alpha, masked, view, half_cosine) / fmax(fmax(sheen->gain, gain), 1);
    }
    for (int c = 0; c < 3; c++)
        rgb[c] = sheen->color[c] * white;
}
