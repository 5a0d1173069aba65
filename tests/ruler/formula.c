/* SPDX-License-Identifier: MIT */
#include "tests/ruler/formula.h"

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static double phong(const double view[3], const double light[3], double exponent) {
    const double mirror[3] = { -view[0], -view[1], view[2] };
    return (exponent + 1) / (2 * acos(-1)) * pow(fmax(dot(mirror, light), 0), exponent);
}

/* D V cos of glTF 2.0, appendix B */
static double ggx(double alpha, double nh, double nv, double nl) {
    const double a2 = alpha * alpha, d = nh * nh * (a2 - 1) + 1;
    const double shadow = nl * sqrt(a2 + (1 - a2) * nv * nv) + nv * sqrt(a2 + (1 - a2) * nl * nl);
    return a2 / (acos(-1) * d * d) * 0.5 / shadow * nl;
}

static double gltf(const ruler_row *row, diagnosis kind, const double view[3],
                   const double light[3]) {
    const double alpha = row->roughness * row->roughness;
    double half_vector[3] = { view[0] + light[0], view[1] + light[1], view[2] + light[2] };
    const double length = sqrt(dot(half_vector, half_vector)), nl = fabs(light[2]);
    const double vh = dot(view, half_vector) / length;
    const double f0 = row->material == RULER_METAL ? row->color : 0.04;
    const double grazing = kind == DIAGNOSIS_FRESNEL ? 0 : pow(1 - vh, 5);
    const double fresnel = f0 + (1 - f0) * grazing;
    const double specular = kind == DIAGNOSIS_PHONG
                                ? phong(view, light, 2 / (alpha * alpha) - 2)
                                : ggx(alpha, fabs(half_vector[2]) / length, view[2], nl);
    const double diffuse = row->material == RULER_METAL ? 0 : row->color / acos(-1) * nl;
    return fresnel * specular + (1 - fresnel) * diffuse;
}

double formula_at(const ruler_row *row, diagnosis kind, const double light[3]) {
    const double factor = kind == DIAGNOSIS_NORMALIZATION ? acos(-1) : 1;
    double view[3];
    view_of_row(row, view);
    if (row->material == RULER_PHONG)
        return row->color * factor * phong(view, light, row->exponent);
    if (light[2] <= 0 && kind != DIAGNOSIS_HORIZON)
        return 0;
    if (row->material == RULER_LAMBERT)
        return row->color * factor / acos(-1) * fabs(light[2]);
    return factor * gltf(row, kind, view, light);
}

/* Returns the direction at `cosine` and azimuth phi around `axis`. */
static void around(const double axis[3], double cosine, double phi, double direction[3]) {
    const double sine = sqrt(fmax((1 - cosine) * (1 + cosine), 0));
    const double flat = hypot(axis[0], axis[1]);
    const double s[3] = { flat > 0 ? -axis[1] / flat : 1, flat > 0 ? axis[0] / flat : 0, 0 };
    const double t[3] = { axis[1] * s[2] - axis[2] * s[1], axis[2] * s[0] - axis[0] * s[2],
                          axis[0] * s[1] - axis[1] * s[0] };
    for (int k = 0; k < 3; k++)
        direction[k] = cosine * axis[k] + sine * (cos(phi) * s[k] + sin(phi) * t[k]);
}

static double over_cap(const ruler_row *row, diagnosis kind, const double axis[3], double angle,
                       int steps) {
    const double height = 2 * pow(sin(angle * RADIANS / 2), 2), step = 2 * acos(-1) / steps;
    double sum = 0;
    for (int i = 0; i < steps; i++)
        for (int j = 0; j < steps; j++) {
            double direction[3];
            around(axis, 1 - height * (i + 0.5) / steps, step * (j + 0.5), direction);
            sum += formula_at(row, kind, direction);
        }
    return sum * height * step / steps;
}

double formula_over_light(const ruler_row *row, diagnosis kind, int steps) {
    double axis[3];
    ruler_direction(row->light_angle, row->light_azimuth, axis);
    if (row->light == RULER_HEMISPHERE)
        return 0.75 * over_cap(row, kind, axis, 90, steps) +
               0.25 * over_cap(row, kind, axis, 180, steps);
    if (ruler_half_angle(row) > 0)
        return over_cap(row, kind, axis, ruler_half_angle(row), steps);
    const double inner = cos(20 * RADIANS), outer = cos(40 * RADIANS);
    const double falloff = (cos(row->size * RADIANS) - outer) / (inner - outer);
    const double strength = row->light == RULER_SPOT ? pow(fmin(fmax(falloff, 0), 1), 2) : 1;
    return strength * formula_at(row, kind, axis);
}
