/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_ggx.h"

#define ALPHA_MIN 0.001
#define GRAZING   1e-4 /* least cosine of a view */

void reference_ggx_set(reference_ggx *ggx, const double base[3], double metallic, double roughness,
                       const reference_dielectric *dielectric, reference_vec normal,
                       reference_vec view) {
    const double metal = fmin(fmax(metallic, 0), 1), rough = fmin(fmax(roughness, 0), 1);
    ggx->alpha = fmax(rough * rough, ALPHA_MIN);
    for (int c = 0; c < 3; c++) {
        ggx->diffuse[c] = base[c] * (1 - metal);
        ggx->f0[c] = dielectric->f0[c] + (base[c] - dielectric->f0[c]) * metal;
    }
    ggx->f90 = dielectric->f90 + (1 - dielectric->f90) * metal;
    ggx->layer_f0 = fmax(dielectric->f0[0], fmax(dielectric->f0[1], dielectric->f0[2]));
    ggx->layer_f90 = dielectric->f90;
    ggx->z = normal;
    ggx->x = reference_around(normal, 0, 1, 0);
    ggx->y = reference_cross(normal, ggx->x);
    const double cosine = fmax(reference_dot(view, normal), GRAZING);
    const double x = reference_dot(view, ggx->x), y = reference_dot(view, ggx->y);
    const double flat = sqrt((1 - fmin(cosine, 1)) * (1 + cosine)), length = hypot(x, y);
    ggx->view[0] = length > 0 ? x * (flat / length) : 0;
    ggx->view[1] = length > 0 ? y * (flat / length) : 0;
    ggx->view[2] = fmin(cosine, 1);
}

void reference_coat_set(reference_ggx *coat, double weight, double roughness, reference_vec normal,
                        reference_vec view) {
    const double grazing = 1 - fmin(fabs(reference_dot(normal, view)), 1);
    const double part = weight * (0.04 + (1 - 0.04) * pow(grazing, 5));
    const double black[3] = { 0, 0, 0 };
    const reference_dielectric even = { { part, part, part }, part };
    reference_ggx_set(coat, black, 0, roughness, &even, normal, view);
}

/* Evaluates GGX's distribution of normals at a cosine with the surface's normal. */
static double distribution(double alpha, double cosine) {
    const double a2 = alpha * alpha, d = cosine * cosine * (a2 - 1) + 1;
    return a2 / (REFERENCE_PI * d * d);
}

/* Returns sqrt(alpha² + (1 - alpha²) cos²) of Smith's masking. */
static double smith_root(double alpha, double cosine) {
    const double a2 = alpha * alpha;
    return sqrt(a2 + (1 - a2) * cosine * cosine);
}

/* Finds w and the half vector in the frame of the normal; returns false below the horizon. */
static bool find_half_vector(const reference_ggx *ggx, reference_vec w, double light[3],
                             double half_vector[3]) {
    light[0] = reference_dot(w, ggx->x);
    light[1] = reference_dot(w, ggx->y);
    light[2] = reference_dot(w, ggx->z);
    for (int k = 0; k < 3; k++)
        half_vector[k] = light[k] + ggx->view[k];
    const double length = sqrt(half_vector[0] * half_vector[0] + half_vector[1] * half_vector[1] +
                               half_vector[2] * half_vector[2]);
    for (int k = 0; k < 3; k++)
        half_vector[k] /= length;
    return light[2] > 0;
}

static double cosine_between(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

void reference_ggx_at(const reference_ggx *ggx, reference_vec w, double rgb[3]) {
    double light[3], half_vector[3];
    rgb[0] = rgb[1] = rgb[2] = 0;
    if (!find_half_vector(ggx, w, light, half_vector))
        return;
    const double nl = light[2], nv = ggx->view[2];
    const double smith = nl * smith_root(ggx->alpha, nv) + nv * smith_root(ggx->alpha, nl);
    const double specular = 0.5 / smith * distribution(ggx->alpha, half_vector[2]) * nl;
    const double fresnel = pow(1 - fmin(fabs(cosine_between(ggx->view, half_vector)), 1), 5);
    const double passed = 1 - (ggx->layer_f0 + (ggx->layer_f90 - ggx->layer_f0) * fresnel);
    for (int c = 0; c < 3; c++)
        rgb[c] = ggx->diffuse[c] / REFERENCE_PI * passed * nl +
                 (ggx->f0[c] + (ggx->f90 - ggx->f0[c]) * fresnel) * specular;
}

/* Samples visible half vectors: once stretched, the ellipsoid is a sphere, of which half a disk and
 * half an ellipse are seen. */
reference_vec reference_ggx_draw(const reference_ggx *ggx, double u, double v) {
    const double alpha = ggx->alpha;
    const reference_vec up = reference_normalize(
        (reference_vec) { alpha * ggx->view[0], alpha * ggx->view[1], ggx->view[2] });
    const double across2 = up.x * up.x + up.y * up.y;
    const reference_vec s =
        across2 > 0 ? reference_scale(1 / sqrt(across2), (reference_vec) { -up.y, up.x, 0 })
                    : (reference_vec) { 1, 0, 0 };
    const reference_vec t = reference_cross(up, s);
    const double r = sqrt(u), phi = 2 * REFERENCE_PI * v, a = r * cos(phi),
                 fraction = (1 + up.z) / 2;
    const double b = (1 - fraction) * sqrt(1 - a * a) + fraction * r * sin(phi);
    const double c = sqrt(fmax(1 - a * a - b * b, 0));
    const reference_vec seen = reference_add(
        reference_add(reference_scale(a, s), reference_scale(b, t)), reference_scale(c, up));
    const reference_vec half_vector =
        reference_normalize((reference_vec) { alpha * seen.x, alpha * seen.y, fmax(seen.z, 0) });
    const reference_vec view = { ggx->view[0], ggx->view[1], ggx->view[2] };
    const reference_vec light = reference_mirror(view, half_vector);
    return reference_normalize(reference_add(
        reference_add(reference_scale(light.x, ggx->x), reference_scale(light.y, ggx->y)),
        reference_scale(light.z, ggx->z)));
}

double reference_ggx_density(const reference_ggx *ggx, reference_vec w) {
    double light[3], half_vector[3];
    find_half_vector(ggx, w, light, half_vector);
    if (!(half_vector[2] > 0))
        return 0;
    /* density of reflected directions: G1 D / (4 n·v) */
    return distribution(ggx->alpha, half_vector[2]) /
           (2 * (ggx->view[2] + smith_root(ggx->alpha, ggx->view[2])));
}

double reference_ggx_near(double alpha, double cosine) {
    return distribution(alpha, sqrt(fmax((1 + cosine) / 2, 0))) / 4;
}
