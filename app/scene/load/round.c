/* SPDX-License-Identifier: MIT */
#include "app/scene/load/round.h"

#include "app/scene/light.h"
#include "app/scene/vector.h"

/* How far corners may be inside the tube, in radii, and the least part of its surface. */
static const double off_most = 0.02, surface_least = 0.98;
/* How many times as long as thick a body with flat ends is, and how long it is at least. */
static const double flat_ends = 30, longest = 1.5;
enum { STEPS = 64 };

/* The surface, its middle, and the axis through it. */
typedef struct spindle {
    double surface, middle[3], axis[3];
    double low, high, radius; /* along the axis from the middle, and off it */
} spindle;

static double coordinate(lmp_vec3 v, int k) {
    return (double)(k == 0 ? v.x : k == 1 ? v.y : v.z);
}

static void find_middle(const piece_triangle *triangles, size_t count, spindle *s) {
    for (size_t i = 0; i < count; i++) {
        const double area = piece_triangle_area(&triangles[i]);
        s->surface += area;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++)
                s->middle[k] += area / 3 * coordinate(triangles[i].corner[c], k);
    }
    for (int k = 0; k < 3; k++)
        s->middle[k] /= s->surface;
}

/* Finds the direction in which the surface extends most, by powers of its second moments. */
static void find_axis(const piece_triangle *triangles, size_t count, spindle *s) {
    double moments[3][3] = { { 0 } };
    for (size_t i = 0; i < count; i++) {
        const double area = piece_triangle_area(&triangles[i]);
        for (int c = 0; c < 3; c++)
            for (int j = 0; j < 3; j++)
                for (int k = 0; k < 3; k++)
                    moments[j][k] += area * (coordinate(triangles[i].corner[c], j) - s->middle[j]) *
                                     (coordinate(triangles[i].corner[c], k) - s->middle[k]);
    }
    s->axis[0] = 0.6;
    s->axis[1] = 0.64;
    s->axis[2] = 0.48;
    for (int step = 0; step < STEPS; step++) {
        double next[3], length = 0;
        for (int j = 0; j < 3; j++) {
            next[j] = moments[j][0] * s->axis[0] + moments[j][1] * s->axis[1] +
                      moments[j][2] * s->axis[2];
            length += next[j] * next[j];
        }
        for (int j = 0; j < 3 && length > 0; j++)
            s->axis[j] = next[j] / sqrt(length);
    }
}

/* Finds where a corner lies along the axis and how far off it. */
static void place(const spindle *s, lmp_vec3 corner, double *along, double *off) {
    double square = 0;
    *along = 0;
    for (int k = 0; k < 3; k++) {
        const double from = coordinate(corner, k) - s->middle[k];
        *along += from * s->axis[k];
        square += from * from;
    }
    *off = sqrt(fmax(square - *along * *along, 0));
}

static void measure(const piece_triangle *triangles, size_t count, spindle *s) {
    s->low = (double)INFINITY;
    s->high = -(double)INFINITY;
    for (size_t i = 0; i < 3 * count; i++) {
        double along, off;
        place(s, triangles[i / 3].corner[i % 3], &along, &off);
        s->low = fmin(s->low, along);
        s->high = fmax(s->high, along);
        s->radius = fmax(s->radius, off);
    }
}

/* Whether all corners are on a tube of half the length, or, with flat ends, on its side or at its
 * ends. */
static bool are_on(const piece_triangle *triangles, size_t count, const spindle *s, double half,
                   bool flat) {
    const double middle = 0.5 * (s->low + s->high);
    for (size_t i = 0; i < 3 * count; i++) {
        double along, off;
        place(s, triangles[i / 3].corner[i % 3], &along, &off);
        const double past = fmax(fabs(along - middle) - half, 0);
        const double away = flat ? off : sqrt(off * off + past * past);
        const bool at_end = flat && fabs(along - middle) > half - s->radius;
        if (!at_end && !(fabs(away - s->radius) <= off_most * s->radius))
            return false;
    }
    return true;
}

bool round_make_tube(const piece_triangle *triangles, size_t count, lmp_light *tube) {
    spindle s = { .surface = 0 };
    find_middle(triangles, count, &s);
    if (!(s.surface > 0))
        return false;
    find_axis(triangles, count, &s);
    measure(triangles, count, &s);
    const double reach = 0.5 * (s.high - s.low), r = s.radius;
    const double side = 4 * (double)PI * r * reach; /* of either tube */
    const bool flat = !are_on(triangles, count, &s, reach - r, false);
    if (!(reach > longest * r) || (flat && !(reach > flat_ends * r)) ||
        !(s.surface >= surface_least * side) ||
        (flat && !are_on(triangles, count, &s, reach, true)))
        return false;
    const double half = flat ? reach : reach - r, middle = 0.5 * (s.low + s.high);
    *tube = scene_light_tube(
        vec((float)(s.middle[0] + middle * s.axis[0]), (float)(s.middle[1] + middle * s.axis[1]),
            (float)(s.middle[2] + middle * s.axis[2])),
        vec((float)(half * s.axis[0]), (float)(half * s.axis[1]), (float)(half * s.axis[2])),
        (float)r);
    return true;
}
