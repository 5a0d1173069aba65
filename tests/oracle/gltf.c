/* SPDX-License-Identifier: MIT */
#include "tests/oracle/gltf.h"
#include "tests/oracle/oracle.h"

#include <math.h>
#include <stdbool.h>

#define PI ORACLE_PI

enum { NODES = 16, PANELS = 8 };

/* --- integrals over caps ------------------------------------------------------------------------
 * A cap of half angle a, `to` from a pole, in polar coordinates around that pole: the square roots
 * where its circles touch the cap go into psi, theta = to + a sin psi. */

typedef struct quadrature {
    double node[NODES], weight[NODES];
} quadrature;

static const quadrature *gauss(void) {
    static quadrature q;
    if (q.weight[0] == 0)
        oracle_gauss_legendre(NODES, q.node, q.weight);
    return &q;
}

/* Returns ∫ over the part of a ring that is in the cap, by theta and by half the length of the arc.
 */
typedef double (*ring_function)(double theta, double half_arc, const void *user);

static double half_arc(double to, double a, double theta) {
    if (theta <= a - to)
        return PI;
    const double s = sin((a + theta - to) / 2) * sin((a - theta + to) / 2) / (sin(theta) * sin(to));
    return 2 * asin(sqrt(fmin(fmax(s, 0), 1)));
}

/* Integrates between two angles theta; `full` means that the rings are whole. */
static double integrate_panel(double to, double a, double low, double high, bool full,
                              ring_function function, const void *user) {
    const double from = full ? low : asin(fmin(fmax((low - to) / a, -1), 1));
    const double until = full ? high : asin(fmin(fmax((high - to) / a, -1), 1));
    double sum = 0;
    for (int i = 0; i < NODES; i++) {
        const double t = (from + until) / 2 + (until - from) / 2 * gauss()->node[i];
        const double theta = full ? t : to + a * sin(t), scale = full ? 1 : a * cos(t);
        sum +=
            gauss()->weight[i] * scale * sin(theta) * function(theta, half_arc(to, a, theta), user);
    }
    return sum * (until - from) / 2;
}

/* Integrates up to 90 degrees from the pole, in panels that grow threefold from `peak`, the first
 * of them `width` / 4 long. */
static double integrate_cap(double to, double a, double peak, double width, ring_function function,
                            const void *user) {
    const double whole = fmin(fmax(a - to, 0), PI / 2), start = fmin(fabs(to - a), PI / 2);
    const double end = fmin(to + a, PI / 2);
    double sum = 0;
    for (int i = -PANELS; i < PANELS; i++) {
        const double near = i == 0 || i == -1 ? 0 : pow(3, i < 0 ? -2 - i : i - 1) * width / 4;
        const double far =
            i == -PANELS || i == PANELS - 1 ? PI : pow(3, i < 0 ? -1 - i : i) * width / 4;
        const double low = i < 0 ? peak - far : peak + near,
                     high = i < 0 ? peak - near : peak + far;
        if (fmin(high, whole) > fmax(low, 0))
            sum += integrate_panel(to, a, fmax(low, 0), fmin(high, whole), true, function, user);
        if (fmin(high, end) > fmax(low, start))
            sum += integrate_panel(to, a, fmax(low, start), fmin(high, end), false, function, user);
    }
    return sum;
}

/* --- what is integrated ----------------------------------------------------------------------- */

/* Evaluates f_r cos of appendix B. */
static double gltf(const oracle_gltf *s, double theta, double phi) {
    const double nl = cos(theta), nv = cos(s->view), a2 = s->alpha * s->alpha;
    const double vl = nl * nv - sin(theta) * sin(s->view) * cos(phi);
    const double vh = sqrt((1 + vl) / 2), length2 = 2 + 2 * vl;
    const double hx = sin(theta) * cos(phi) - sin(s->view), hy = sin(theta) * sin(phi);
    const double sine2 = (hx * hx + hy * hy) / length2, cosine2 = (nl + nv) * (nl + nv) / length2;
    const double d = a2 / (PI * pow(a2 * cosine2 + sine2, 2));
    const double v =
        0.5 / (nl * sqrt(nv * nv * (1 - a2) + a2) + nv * sqrt(nl * nl * (1 - a2) + a2));
    const double f = s->f0 + (s->f90 - s->f0) * pow(1 - vh, 5);
    return (f * d * v + (1 - f) * s->diffuse / PI) * nl;
}

double oracle_gltf_at(const oracle_gltf *s, const double from[3]) {
    const double across = hypot(from[0], from[1]);
    return from[2] > 0 ? gltf(s, atan2(across, from[2]), atan2(from[1], from[0])) : 0;
}

typedef struct gltf_cap {
    oracle_gltf surface;
    double azimuth;
} gltf_cap;

/* Integrates a ring with azimuths dense around the peak, at 0: phi = width sinh t. */
static double gltf_ring(double theta, double half_arc, const void *user) {
    const gltf_cap *cap = user;
    const oracle_gltf *s = &cap->surface;
    const double x = sin(theta) - sin(s->view), z = s->alpha * (cos(theta) + cos(s->view));
    const double width = sqrt((x * x + z * z) / (sin(theta) * sin(s->view) + 1e-12));
    const double azimuth = half_arc < PI ? cap->azimuth : 0;
    const double low = asinh((azimuth - half_arc) / width);
    const double high = asinh((azimuth + half_arc) / width);
    const double middle = low < 0 && high > 0 ? 0 : (low + high) / 2;
    double sum = 0;
    for (int i = 0; i < 2 * NODES; i++) {
        const double from = i < NODES ? low : middle, until = i < NODES ? middle : high;
        const double t = (from + until) / 2 + (until - from) / 2 * gauss()->node[i % NODES];
        sum += gauss()->weight[i % NODES] * (until - from) / 2 * width * cosh(t) *
               gltf(s, theta, width * sinh(t));
    }
    return sum;
}

double oracle_gltf_cap(const oracle_gltf *s, const double middle[3], double a) {
    const gltf_cap cap = { *s, atan2(middle[1], middle[0]) };
    const double to = fmax(acos(fmin(fmax(middle[2], -1), 1)), 1e-7);
    return integrate_cap(to, a, s->view, s->alpha, gltf_ring, &cap);
}

static double phong_ring(double theta, double half_arc, const void *user) {
    const double e = *(const double *)user;
    return (e + 1) / PI * half_arc * exp(e * log(fmax(cos(theta), 1e-300)));
}

double oracle_phong_cap(double exponent, double to, double a) {
    return integrate_cap(fmax(to, 1e-7), a, 0, 1 / sqrt(exponent + 1), phong_ring, &exponent);
}
