/* SPDX-License-Identifier: MIT */
#include "app/scene/leak.h"

#include "app/scene/vector.h"

#include <math.h>
#include <stdbool.h>

enum { RAYS = 128 };

/* Hits nearer than this part of a ray's triangle are where it starts, rounded. */
static const double nearest = 1e-6;

static void cross(const double a[3], const double b[3], double to[3]) {
    for (int k = 0; k < 3; k++) {
        const int d = (k + 1) % 3, e = (k + 2) % 3;
        to[k] = a[d] * b[e] - a[e] * b[d];
    }
}

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Finds the two edges from the first corner, and their cross product: twice the area, to the
 * front. */
static void find_edges(const leak_triangle *t, double edges[2][3], double across[3]) {
    for (int k = 0; k < 3; k++) {
        edges[0][k] = (double)t->corner[1][k] - (double)t->corner[0][k];
        edges[1][k] = (double)t->corner[2][k] - (double)t->corner[0][k];
    }
    cross(edges[0], edges[1], across);
}

static double twice_area(const leak_triangle *t) {
    double edges[2][3], across[3];
    find_edges(t, edges, across);
    return sqrt(dot(across, across));
}

typedef struct ray {
    double from[3], along[3];
} ray;

/* Draws ray i of all that start on a triangle's side, evenly over its area and by the cosine. The
 * numbers are those of an additive recurrence in four dimensions, whose steps are powers of the
 * root of x^5 = x + 1 (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018). */
static ray draw(const leak_triangle *t, int side, int i) {
    static const double steps[4] = { 0.8566748838545029, 0.7338918566271259, 0.6287067210378087,
                                     0.5385972572236101 };
    double edges[2][3], across[3], x[3], y[3], u[4];
    find_edges(t, edges, across);
    for (int k = 0; k < 4; k++)
        u[k] = fmod(0.5 + steps[k] * i, 1);
    const bool folds = u[0] + u[1] > 1;
    const double b = folds ? 1 - u[0] : u[0], c = folds ? 1 - u[1] : u[1];
    const double angle = 2 * (double)PI * u[2], out = sqrt(u[3]), up = side * sqrt(1 - u[3]);
    const double length = sqrt(dot(edges[0], edges[0])), twice = sqrt(dot(across, across));
    for (int k = 0; k < 3; k++) {
        x[k] = edges[0][k] / length;
        across[k] /= twice;
    }
    cross(across, x, y);
    ray r;
    for (int k = 0; k < 3; k++) {
        r.from[k] = (double)t->corner[0][k] + b * edges[0][k] + c * edges[1][k];
        r.along[k] = length * (out * (cos(angle) * x[k] + sin(angle) * y[k]) + up * across[k]);
    }
    return r;
}

/* Möller and Trumbore, Fast, Minimum Storage Ray/Triangle Intersection (1997). */
static bool meets(const ray *r, const leak_triangle *t) {
    double edges[2][3], across[3], from[3], aside[3];
    find_edges(t, edges, across);
    for (int k = 0; k < 3; k++)
        from[k] = r->from[k] - (double)t->corner[0][k];
    const double facing = -dot(across, r->along);
    if (facing == 0)
        return false;
    cross(from, r->along, aside);
    const double u = dot(edges[1], aside) / facing, v = -dot(edges[0], aside) / facing;
    return u >= 0 && v >= 0 && u + v <= 1 && dot(across, from) / facing > nearest;
}

static bool leaves(const ray *r, const leak_triangle *triangles, size_t count) {
    for (size_t i = 0; i < count; i++)
        if (meets(r, &triangles[i]))
            return false;
    return true;
}

double leak_part(const leak_triangle *triangles, size_t count, int side, double most) {
    double whole = 0, before = 0;
    int left = 0, drawn = 0;
    for (size_t i = 0; i < count; i++)
        whole += twice_area(&triangles[i]);
    if (!(whole > 0))
        return 1;
    for (size_t i = 0; i < count && left <= most * RAYS; i++) {
        before += twice_area(&triangles[i]);
        for (; drawn < RAYS && (drawn + 0.5) * whole < RAYS * before; drawn++) {
            const ray r = draw(&triangles[i], side, drawn);
            left += leaves(&r, triangles, count);
        }
    }
    return (double)left / RAYS;
}
