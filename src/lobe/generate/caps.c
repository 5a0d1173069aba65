/* SPDX-License-Identifier: MIT */
#include "src/lobe/generate/caps.h"
#include "src/sh/quadrature.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

enum { RINGS = 48, RINGS_FEW = 24 }; /* rings of a cap, and azimuths of a ring */

typedef struct quadrature {
    int count;
    double node[RINGS], weight[RINGS];
} quadrature;

static quadrature fine = { .count = RINGS }, coarse = { .count = RINGS_FEW };

void caps_start(void) {
    for (int i = 0; i < RINGS; i++)
        lmpi_gauss_legendre(RINGS, i, &fine.node[i], &fine.weight[i]);
    for (int i = 0; i < RINGS_FEW; i++)
        lmpi_gauss_legendre(RINGS_FEW, i, &coarse.node[i], &coarse.weight[i]);
}

/* --- caps ------------------------------------------------------------------------------------- */

/* A cap of half angle a, `to` from a pole, as arcs of circles around the pole: of each the angle to
 * the pole, half the arc, and the weight of the circle. Only directions within `limit` of the pole
 * count. The square roots at the two circles that touch the cap go into the variable: in psi, with
 * theta = to + a sin psi, Gauss-Legendre converges exponentially. */
typedef struct ring {
    double z, sine, half_arc, weight;
} ring;

static int cap_rings(const quadrature *q, double to, double a, double limit,
                     ring rings[2 * RINGS]) {
    int count = 0;
    const double full = fmin(a - to, limit);
    for (int i = 0; full > 0 && i < q->count; i++) {
        const double theta = full * (1 + q->node[i]) / 2;
        rings[count++] =
            (ring) { cos(theta), sin(theta), pi, full / 2 * q->weight[i] * sin(theta) };
    }
    if (a - to >= limit || to - a >= limit)
        return count;
    const double low = asin(fmin(fmax((fabs(to - a) - to) / a, -1), 1));
    const double high = to + a <= limit ? pi / 2 : asin((limit - to) / a);
    for (int i = 0; i < q->count; i++) {
        const double psi = (low + high) / 2 + (high - low) / 2 * q->node[i];
        const double theta = to + a * sin(psi), sine = sin(theta);
        const double s2 = sin((a + theta - to) / 2) * sin((a - theta + to) / 2) / (sine * sin(to));
        rings[count++] = (ring) { cos(theta), sine, 2 * asin(sqrt(fmin(fmax(s2, 0), 1))),
                                  (high - low) / 2 * q->weight[i] * a * cos(psi) * sine };
    }
    return count;
}

/* --- GGX, glTF 2.0 appendix B ----------------------------------------------------------------- */

static void ggx_add(const ggx_view *view, double x, double y, double z, double weight,
                    double value[3]) {
    const double a2 = view->alpha * view->alpha;
    const double along = 1 + view->z * z - view->sine * x; /* 1 + v·l = 2 (v·h)² */
    if (!(along > 0))
        return;
    const double tangential = (x - view->sine) * (x - view->sine) + y * y;
    const double q = (tangential + a2 * (z + view->z) * (z + view->z)) / (2 * along);
    const double visible = 0.5 * z / (z * view->masking + view->z * sqrt(a2 + (1 - a2) * z * z));
    const double u = 1 - sqrt(along / 2), schlick = u * u * u * u * u;
    const double all = weight * a2 / (pi * q * q) * visible;
    value[0] += all * (1 - schlick);
    value[1] += all * schlick;
    value[2] += weight * schlick * z / pi;
}

/* Computes the reflected radiance of a cap of radiance 1 around (sin t cos p, sin t sin p, cos t).
 */
void caps_ggx(const ggx_view *view, double t, double p, double a, double value[3]) {
    const quadrature *q = view->alpha < 0.25 ? &fine : &coarse;
    ring rings[2 * RINGS];
    const int count = cap_rings(q, t, a, pi / 2, rings);
    value[0] = value[1] = value[2] = 0;
    for (int i = 0; i < count; i++) {
        const ring *r = &rings[i];
        const double x = r->sine - view->sine, z = view->alpha * (r->z + view->z);
        const double width = sqrt((x * x + z * z) / (r->sine * view->sine + 1e-9));
        const double low = asinh((p - r->half_arc) / width),
                     high = asinh((p + r->half_arc) / width);
        for (int k = 0; k < q->count; k++) {
            const double s = (low + high) / 2 + (high - low) / 2 * q->node[k];
            const double phi = width * sinh(s);
            const double weight = (high - low) / 2 * q->weight[k] * width * cosh(s) * r->weight;
            ggx_add(view, r->sine * cos(phi), r->sine * sin(phi), r->z, weight, value);
        }
    }
}

/* Computes the reflected radiance of a whole sky of radiance 1, over visible normals (Heitz 2018),
 * whose integrand no roughness makes peaked. */
void caps_ggx_sky(const ggx_view *view, double value[3]) {
    const double stretched = hypot(view->alpha * view->sine, view->z);
    const double vx = -view->alpha * view->sine / stretched, vz = view->z / stretched;
    value[0] = value[1] = 0;
    value[2] = caps_diffuse(view->z);
    for (int i = 0; i < RINGS * RINGS; i++) {
        const double r = sqrt((1 + fine.node[i / RINGS]) / 2),
                     phi = pi * (1 + fine.node[i % RINGS]);
        const double weight = fine.weight[i / RINGS] * fine.weight[i % RINGS] / 4;
        const double t1 = r * cos(phi), blend = (1 + vz) / 2;
        const double t2 = (1 - blend) * sqrt(1 - t1 * t1) + blend * r * sin(phi);
        const double t3 = sqrt(fmax(0, 1 - t1 * t1 - t2 * t2));
        /* in the frame of the stretched view: y, then the upward tangent, then the view */
        double x = view->alpha * (t2 * vz + t3 * vx), y = view->alpha * t1;
        double z = fmax(1e-9, t3 * vz - t2 * vx);
        const double length = sqrt(x * x + y * y + z * z);
        x /= length, y /= length, z /= length;
        const double vh = -view->sine * x + view->z * z, lz = 2 * vh * z - view->z;
        if (!(lz > 0 && vh > 0))
            continue;
        const double a2 = view->alpha * view->alpha;
        const double masked = lz * view->masking,
                     shadowed = view->z * sqrt(a2 + (1 - a2) * lz * lz);
        const double fraction = lz * (view->z + view->masking) / (masked + shadowed);
        const double schlick = pow(1 - vh, 5);
        value[0] += weight * fraction * (1 - schlick);
        value[1] += weight * fraction * schlick;
    }
}

double caps_cosine(double t, double a) {
    if (t + a <= pi / 2 || a >= pi / 2)
        return a >= pi / 2 ? 1 : sin(a) * sin(a) * cos(t);
    ring rings[2 * RINGS];
    const int count = cap_rings(&fine, t, a, pi / 2, rings);
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += rings[i].weight * 2 * rings[i].half_arc * rings[i].z;
    return sum / pi;
}

/* --- Phong lobes over caps -------------------------------------------------------------------- */

static double phong_cap(double exponent, double angle, double a) {
    ring rings[2 * RINGS];
    const int count = cap_rings(&fine, angle, a, fmin(pi / 2, 9 / sqrt(exponent + 1)), rings);
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum +=
            rings[i].weight * 2 * rings[i].half_arc * exp(exponent * log(fmax(rings[i].z, 1e-300)));
    return sum * (exponent + 1) / (2 * pi);
}

static double exponent_of(double alpha, double spread_log) {
    return exp(-spread_log) / (alpha * alpha);
}

void caps_table_fill(caps_table *table, double alpha, double a) {
    table->angle_max = fmin(pi, a + 24 * alpha);
    for (int i = 0; i < CAPS_ANGLES; i++)
        for (int k = 0; k < CAPS_SPREADS; k++) {
            const double log_spread =
                CAPS_SPREAD_LOG_MIN +
                (CAPS_SPREAD_LOG_MAX - CAPS_SPREAD_LOG_MIN) * k / (CAPS_SPREADS - 1);
            table->value[i][k] = phong_cap(exponent_of(alpha, log_spread),
                                           fmax(1e-9, table->angle_max * i / (CAPS_ANGLES - 1)), a);
        }
}

/* Computes the Catmull-Rom weights of four neighbors, and their derivatives. */
static void cubic(double f, double w[4], double d[4]) {
    w[0] = f * (-1 + f * (2 - f)) / 2;
    w[1] = 1 + f * f * (3 * f - 5) / 2;
    w[2] = f * (1 + f * (4 - 3 * f)) / 2;
    w[3] = f * f * (f - 1) / 2;
    d[0] = (-1 + f * (4 - 3 * f)) / 2;
    d[1] = f * (9 * f - 10) / 2;
    d[2] = (1 + f * (8 - 9 * f)) / 2;
    d[3] = f * (3 * f - 2) / 2;
}

/* Returns the value, and its derivatives by angle and by the log of the spread. */
void caps_table_at(const caps_table *table, double angle, double spread_log, double result[3]) {
    const double rows = (CAPS_ANGLES - 1) / table->angle_max;
    const double columns = (CAPS_SPREADS - 1) / (CAPS_SPREAD_LOG_MAX - CAPS_SPREAD_LOG_MIN);
    const double x = angle * rows, y = (spread_log - CAPS_SPREAD_LOG_MIN) * columns;
    result[0] = result[1] = result[2] = 0;
    if (x >= CAPS_ANGLES - 2)
        return;
    const int i = (int)x, k = y < 1 ? 1 : y >= CAPS_SPREADS - 3 ? CAPS_SPREADS - 3 : (int)y;
    double wx[4], dx[4], wy[4], dy[4];
    cubic(x - i, wx, dx);
    cubic(fmin(fmax(y - k, -1), 2), wy, dy);
    for (int r = 0; r < 4; r++) {
        const double *row = table->value[abs(i - 1 + r)] + k - 1;
        double value = 0, slope = 0;
        for (int c = 0; c < 4; c++) {
            value += wy[c] * row[c];
            slope += dy[c] * row[c];
        }
        result[0] += wx[r] * value;
        result[1] += dx[r] * value * rows;
        result[2] += wx[r] * slope * columns;
    }
}

/* --- the diffuse part ------------------------------------------------------------------------- */

/* Computes what Schlick's (1 - v·h)^5 takes from a diffuse surface, in all directions: ∫ (1 -
 * v·h)^5 cos / pi. */
double caps_diffuse(double z) {
    const double sine = sqrt(1 - z * z);
    double sum = 0;
    for (int i = 0; i < RINGS; i++)
        for (int k = 0; k < RINGS; k++) {
            const double cosine = (1 + fine.node[i]) / 2, phi = pi * (1 + fine.node[k]) / 2;
            const double along = z * cosine - sine * sqrt(1 - cosine * cosine) * cos(phi);
            const double u = 1 - sqrt(fmax(0, 1 + along) / 2);
            sum += fine.weight[i] * fine.weight[k] * cosine * u * u * u * u * u;
        }
    return sum / 2;
}
