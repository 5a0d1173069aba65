/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_quadrature.h"

#include <stdlib.h>

/* The overlap of a lobe k(q·w) with a cap around another axis is a single integral over the angle g
 * from q: ∫ k(cos g) sin g arc(g) dg, where arc(g) is the length, in radians of azimuth around q,
 * of the part of the circle at g that lies in the cap. */
typedef struct overlap {
    const reference_lobe *lobe;
    double between; /* angle from q to the cap's axis */
    double angle;   /* half angle of the cap */
} overlap;

/* Evaluates arc(g) by the half-angle formula of the spherical triangle with sides g, between,
 * angle. */
static double arc(const overlap *o, double g) {
    const double s = (g + o->between + o->angle) / 2;
    const double near_side = sin(s - g) * sin(s - o->between);
    const double far_side = sin(s) * sin(s - o->angle);
    if (o->angle >= g + o->between || s >= REFERENCE_PI)
        return 2 * REFERENCE_PI;
    if (!(near_side > 0))
        return 0;
    return 4 * atan2(sqrt(near_side), sqrt(fmax(far_side, 0)));
}

static double ring(double g, void *user) {
    const overlap *o = user;
    return reference_lobe_at(o->lobe, cos(g)) * sin(g) * arc(o, g);
}

#define LEVELS_MAX 10
#define REACH      3.2 /* of the substitution's variable: the ends are then 1e-17 away */

double reference_integrate(reference_integrand f, void *user, double low, double high) {
    const double half_width = (high - low) / 2;
    double sum = 0, before = 0, step = 0.5;
    if (!(half_width > 0))
        return 0;
    for (int level = 0; level < LEVELS_MAX; level++, step /= 2) {
        /* each level adds the odd multiples of its step */
        for (double t = level ? step : 0; t <= REACH; t += level ? 2 * step : step) {
            const double v = REFERENCE_PI / 2 * sinh(t), c = cosh(v);
            const double from_end = half_width * exp(-v) / c;
            const double weight = half_width * REFERENCE_PI / 2 * cosh(t) / (c * c);
            sum += weight * (f(low + from_end, user) + (t > 0 ? f(high - from_end, user) : 0));
        }
        const double now = sum * step;
        if (level > 3 && fabs(now - before) <= 1e-13 * fabs(now))
            return now;
        before = now;
    }
    return before;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The integrand is smooth between breaks: where the circle enters, leaves and fills the cap, where
 * the lobe ends, and at a few multiples of its width. */
#define BREAKS 12
static void set_breaks(const overlap *o, double breaks[BREAKS]) {
    const double width = 1 / sqrt(o->lobe->exponent + 1);
    const double out = o->between + o->angle;
    const double low = fmax(o->between - o->angle, 0), high = fmin(out, REFERENCE_PI);
    const double at[BREAKS] = { low,
                                high,
                                fabs(o->between - o->angle),
                                REFERENCE_PI / 2,
                                width,
                                2 * width,
                                4 * width,
                                8 * width,
                                16 * width,
                                32 * width,
                                out > REFERENCE_PI ? 2 * REFERENCE_PI - out : high,
                                width / 2 };
    for (int i = 0; i < BREAKS; i++)
        breaks[i] = fmin(fmax(at[i], low), high);
    qsort(breaks, BREAKS, sizeof *breaks, by_value);
}

static double lobe_over_cap(const reference_lobe *lobe, const reference_source *cap) {
    overlap o = { lobe, reference_angle(lobe->axis, cap->axis), cap->angle };
    double breaks[BREAKS], sum = 0;
    set_breaks(&o, breaks);
    for (int i = 0; i + 1 < BREAKS; i++)
        sum += reference_integrate(ring, &o, breaks[i], breaks[i + 1]);
    return sum;
}

static void add_source(const reference_surface *surface, const reference_source *source,
                       double radiance[3]) {
    for (int k = 0; k < surface->lobe_count; k++) {
        const reference_lobe *lobe = &surface->lobes[k];
        const double reflected =
            source->solid_angle > 0
                ? lobe_over_cap(lobe, source)
                : reference_lobe_at(lobe, reference_dot(lobe->axis, source->axis));
        for (int c = 0; c < 3; c++)
            radiance[c] += lobe->weight[c] * reflected * source->color[c];
    }
}

void reference_quadrature(const reference_surface *surface, const scene_light *lights, size_t count,
                          double radiance[3]) {
    radiance[0] = radiance[1] = radiance[2] = 0;
    for (size_t i = 0; i < count; i++) {
        reference_source sources[REFERENCE_SOURCES_MAX];
        const int parts =
            reference_light_sources(&lights[i], surface->position, surface->band_limited, sources);
        for (int k = 0; k < parts; k++)
            add_source(surface, &sources[k], radiance);
    }
}
