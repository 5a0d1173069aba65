/* SPDX-License-Identifier: MIT */
#include "tests/oracle/area.h"

#include "tests/oracle/oracle.h"

#include <math.h>
#include <string.h>

enum { ORDER = 16, DEPTH = 60 };

typedef struct spot {
    double p[3];    /* from the viewer */
    double area[3]; /* the surface of a unit of the patch, along its normal */
} spot;

/* A surface over the unit square, turned to the viewer, and what its points are made from. */
typedef struct patch {
    void (*at)(const struct patch *patch, double x, double y, spot *to);
    double a[3], b[3], c[3], from, to, r, along, across;
    oracle_direction *use;
    void *user;
    double nodes[ORDER], weights[ORDER], fine;
    const double *normal; /* NULL, or that of a horizon at which the integrand has a kink */
} patch;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(const double a[3], const double b[3], double to[3]) {
    to[0] = a[1] * b[2] - a[2] * b[1];
    to[1] = a[2] * b[0] - a[0] * b[2];
    to[2] = a[0] * b[1] - a[1] * b[0];
}

static void unit(double v[3]) {
    const double length = sqrt(dot(v, v));
    for (int i = 0; i < 3; i++)
        v[i] /= length;
}

static void across_of(const double axis[3], double x[3], double y[3]) {
    const double z[3] = { fabs(axis[0]) < 0.5, fabs(axis[0]) >= 0.5, 0 };
    cross(axis, z, x);
    unit(x);
    cross(axis, x, y);
}

/* --- patches ---------------------------------------------------------------------------------- */

/* a + x b + y c */
static void parallelogram(const patch *p, double x, double y, spot *to) {
    cross(p->b, p->c, to->area);
    for (int i = 0; i < 3; i++)
        to->p[i] = p->a[i] + x * p->b[i] + y * p->c[i];
}

/* a + x (b + y (c - b)), a triangle */
static void triangle(const patch *p, double x, double y, spot *to) {
    cross(p->b, p->c, to->area);
    for (int i = 0; i < 3; i++) {
        to->area[i] *= x;
        to->p[i] = p->a[i] + x * (p->b[i] + y * (p->c[i] - p->b[i]));
    }
}

/* A quarter of a disk around a: b and c are its radii. */
static void sector(const patch *p, double x, double y, spot *to) {
    const double angle = ORACLE_PI / 2 * y, cosine = cos(angle), sine = sin(angle);
    cross(p->b, p->c, to->area);
    for (int i = 0; i < 3; i++) {
        to->area[i] *= x * ORACLE_PI / 2;
        to->p[i] = p->a[i] + x * (cosine * p->b[i] + sine * p->c[i]);
    }
}

/* The seen side of a cylinder from a - b to a + b; c is the unit vector across, to the viewer. */
static void cylinder(const patch *p, double x, double y, spot *to) {
    const double angle = p->across * (2 * y - 1);
    double axis[3] = { p->b[0], p->b[1], p->b[2] }, side[3], n[3];
    const double length = sqrt(dot(axis, axis));
    unit(axis);
    cross(axis, p->c, side);
    for (int i = 0; i < 3; i++) {
        n[i] = cos(angle) * p->c[i] + sin(angle) * side[i];
        to->p[i] = p->a[i] + (2 * x - 1) * p->b[i] + p->r * n[i];
        to->area[i] = n[i] * 2 * length * 2 * p->across * p->r;
    }
}

/* The seen part between two latitudes of the sphere around a, whose pole is b; the meridian of c
 * faces the viewer. Sines remove the roots at the ends. */
static void dome(const patch *p, double x, double y, spot *to) {
    const double middle = (p->from + p->to) / 2, half = (p->to - p->from) / 2;
    const double latitude = middle + half * sin(ORACLE_PI * (x - 0.5));
    const double d_latitude = half * ORACLE_PI * cos(ORACLE_PI * (x - 0.5));
    const double up = sin(latitude), level = cos(latitude);
    const double limit = (p->r - p->along * up) / (p->across * level);
    const double widest = limit >= 1 ? 0 : limit <= -1 ? ORACLE_PI : acos(limit);
    const double angle = widest * (2 * y - 1);
    double side[3], n[3];
    cross(p->b, p->c, side);
    for (int i = 0; i < 3; i++) {
        n[i] = up * p->b[i] + level * (cos(angle) * p->c[i] + sin(angle) * side[i]);
        to->p[i] = p->a[i] + p->r * n[i];
        to->area[i] = n[i] * p->r * p->r * level * 2 * widest * d_latitude;
    }
}

/* --- quadrature ------------------------------------------------------------------------------- */

static double distance2(const double a[3], const double b[3]) {
    const double d[3] = { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
    return dot(d, d);
}

/* A cell of the unit square. */
typedef struct cell {
    double x, y, width, height;
} cell;

/* Returns the side by which to halve a cell, 0 or 1; or -1 if it is so small for its distance that
 * its nodes err by less than 1e-9. */
static int side_to_halve(const patch *p, const cell *c) {
    spot at[3][3];
    double nearest = HUGE_VAL, lengths[2] = { 0, 0 }, fine = p->fine;
    int above = 0;
    if (p->at != parallelogram && c->height > 0.25)
        return 1; /* a patch may go all around, where a cell's corners meet */
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            p->at(p, c->x + c->width * i / 2, c->y + c->height * k / 2, &at[i][k]);
            nearest = fmin(nearest, dot(at[i][k].p, at[i][k].p));
            above += p->normal && dot(p->normal, at[i][k].p) > 0;
        }
    if (above % 9 != 0)
        fine = 1. / 512;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 2; k++) {
            lengths[0] = fmax(lengths[0], distance2(at[k][i].p, at[k + 1][i].p));
            lengths[1] = fmax(lengths[1], distance2(at[i][k].p, at[i][k + 1].p));
        }
    const int longer = lengths[1] > lengths[0];
    return lengths[longer] <= fine * fine * nearest ? -1 : longer;
}

static void take(const patch *p, const cell *c) {
    for (int i = 0; i < ORDER; i++)
        for (int k = 0; k < ORDER; k++) {
            spot s;
            p->at(p, c->x + c->width * (1 + p->nodes[i]) / 2,
                  c->y + c->height * (1 + p->nodes[k]) / 2, &s);
            const double d2 = dot(s.p, s.p), d = sqrt(d2);
            const double w[3] = { s.p[0] / d, s.p[1] / d, s.p[2] / d };
            const double size = c->width * c->height * p->weights[i] * p->weights[k] / 4;
            p->use(w, -dot(s.area, w) / d2 * size, p->user);
        }
}

static void divide(const patch *p, cell c, int depth) {
    const int side = side_to_halve(p, &c);
    if (depth == 0 || side < 0) {
        take(p, &c);
        return;
    }
    *(side ? &c.height : &c.width) /= 2;
    divide(p, c, depth - 1);
    *(side ? &c.y : &c.x) += side ? c.height : c.width;
    divide(p, c, depth - 1);
}

static void integrate(const patch *p) {
    divide(p, (cell) { 0, 0, 1, 1 }, DEPTH);
}

/* --- kinds ------------------------------------------------------------------------------------ */

static void wide(lmp_vec3 v, double to[3]) {
    to[0] = (double)v.x, to[1] = (double)v.y, to[2] = (double)v.z;
}

/* Swaps the sides where a flat area is seen from behind; returns false if it is dark there. */
static int is_bright(const lmp_light *light, patch *p, const double normal[3]) {
    const double height = -dot(normal, p->a);
    for (int i = 0; i < 3 && height < 0; i++) {
        const double b = p->b[i];
        p->b[i] = p->c[i];
        p->c[i] = b;
    }
    return height > 0 || (light->two_sided && height < 0);
}

static void rectangle(const lmp_light *light, const double to[3], patch *p) {
    double x[3], y[3], normal[3];
    wide(light->half[0], x);
    wide(light->half[1], y);
    cross(x, y, normal);
    for (int i = 0; i < 3; i++) {
        p->a[i] = to[i] - x[i] - y[i];
        p->b[i] = 2 * x[i];
        p->c[i] = 2 * y[i];
    }
    p->at = parallelogram;
    if (is_bright(light, p, normal))
        integrate(p);
}

/* Integrates the triangles of the first corner, of which some are negative unless it is convex. */
static void polygon(const lmp_light *light, const double to[3], patch *p) {
    double normal[3] = { 0, 0, 0 }, corner[LMP_LIGHT_CORNERS_MAX][3];
    const int count = light->corner_count;
    for (int i = 0; i < count; i++)
        wide(light->corner[i], corner[i]);
    for (int i = 0; i < count; i++) {
        double part[3];
        cross(corner[i], corner[(i + 1) % count], part);
        for (int k = 0; k < 3; k++)
            normal[k] += part[k];
    }
    p->at = triangle;
    for (int i = 1; i + 1 < count; i++) {
        for (int k = 0; k < 3; k++) {
            p->a[k] = to[k] + corner[0][k];
            p->b[k] = corner[i][k] - corner[0][k];
            p->c[k] = corner[i + 1][k] - corner[0][k];
        }
        if (is_bright(light, p, normal))
            integrate(p);
    }
}

static void disk(const lmp_light *light, const double to[3], patch *p) {
    double normal[3], x[3], y[3];
    wide(light->direction, normal);
    unit(normal);
    across_of(normal, x, y);
    p->at = sector;
    for (int quarter = 0; quarter < 4; quarter++) {
        const double radius = (double)light->radius;
        for (int i = 0; i < 3; i++) {
            const double b[4] = { x[i], y[i], -x[i], -y[i] };
            p->a[i] = to[i];
            p->b[i] = radius * b[quarter];
            p->c[i] = radius * b[(quarter + 1) % 4];
        }
        if (is_bright(light, p, normal))
            integrate(p);
    }
}

/* Integrates cells that are halved toward both ends of x, near which the range of meridians may
 * have a root that it does not reach. */
static void integrate_toward_ends(const patch *p) {
    for (double low = 0, high = 1. / 8192; high <= 0.5; low = high, high *= 2) {
        divide(p, (cell) { low, 0, high - low, 1 }, DEPTH);
        divide(p, (cell) { 1 - high, 0, high - low, 1 }, DEPTH);
    }
}

/* Integrates a round end between the latitudes at which the range of seen meridians becomes none or
 * all: there r - along sin x = ± across cos x. */
static void round_end(patch *p) {
    const double length = hypot(p->along, p->across), angle = atan2(p->along, p->across);
    double at[6] = { 0, ORACLE_PI / 2 };
    int count = 2;
    const double roots[4] = { angle + acos(p->r / length), angle - acos(p->r / length),
                              ORACLE_PI - angle + acos(p->r / length),
                              ORACLE_PI - angle - acos(p->r / length) };
    for (int i = 0; i < 4; i++)
        if (roots[i] > 0 && roots[i] < ORACLE_PI / 2)
            at[count++] = roots[i];
    for (int i = 0; i < count; i++)
        for (int k = i + 1; k < count; k++)
            if (at[k] < at[i]) {
                const double swapped = at[i];
                at[i] = at[k];
                at[k] = swapped;
            }
    p->at = dome;
    for (int i = 0; i + 1 < count; i++) {
        p->from = at[i];
        p->to = at[i + 1];
        integrate_toward_ends(p);
    }
}

static void tube(const lmp_light *light, const double to[3], patch *p) {
    double half[3], axis[3];
    wide(light->half[0], half);
    memcpy(axis, half, sizeof axis);
    unit(axis);
    const double along = dot(to, axis);
    for (int i = 0; i < 3; i++) {
        p->c[i] = along * axis[i] - to[i];
        p->a[i] = to[i];
        p->b[i] = half[i];
    }
    const double distance = sqrt(dot(p->c, p->c));
    unit(p->c);
    p->r = (double)light->radius;
    p->across = distance > p->r ? acos(p->r / distance) : 0;
    p->at = cylinder;
    integrate(p);
    for (int end = -1; end <= 1; end += 2) {
        for (int i = 0; i < 3; i++) {
            p->a[i] = to[i] + end * half[i];
            p->b[i] = end * axis[i];
        }
        p->along = -dot(p->a, p->b);
        p->across = distance;
        round_end(p);
    }
}

static void integrate_area(const lmp_light *light, const double point[3], int bands,
                           const double *normal, oracle_direction *use, void *user) {
    patch p = { .use = use, .user = user, .fine = fmin(0.5, 12. / bands), .normal = normal };
    double to[3];
    wide(light->position, to);
    for (int i = 0; i < 3; i++)
        to[i] -= point[i];
    oracle_gauss_legendre(ORDER, p.nodes, p.weights);
    if (light->kind == LMP_LIGHT_RECTANGLE)
        rectangle(light, to, &p);
    else if (light->kind == LMP_LIGHT_DISK)
        disk(light, to, &p);
    else if (light->kind == LMP_LIGHT_TUBE)
        tube(light, to, &p);
    else
        polygon(light, to, &p);
}

void oracle_area(const lmp_light *light, const double point[3], int bands, oracle_direction *use,
                 void *user) {
    integrate_area(light, point, bands, NULL, use, user);
}

/* --- what is integrated ----------------------------------------------------------------------- */

typedef struct integral {
    int bands;
    const double *q;
    double *to, value[LMP_BANDS_MAX * LMP_BANDS_MAX];
} integral;

static void add_harmonics(const double w[3], double solid_angle, void *user) {
    integral *sum = user;
    lmp_sh_eval_double(sum->bands, w, sum->value);
    for (int i = 0; i < sum->bands * sum->bands; i++)
        sum->to[i] += solid_angle * sum->value[i];
}

void oracle_area_project(const lmp_light *light, const double point[3], int bands, double *sh) {
    static integral sum;
    sum.bands = bands;
    sum.to = sh;
    memset(sh, 0, LMP_SH_COUNT(bands) * sizeof *sh);
    oracle_area(light, point, bands, add_harmonics, &sum);
}

static void add_legendre(const double w[3], double solid_angle, void *user) {
    integral *sum = user;
    oracle_legendre(sum->bands, dot(w, sum->q), sum->value);
    for (int l = 0; l < sum->bands; l++)
        sum->to[l] += solid_angle * sum->value[l];
}

void oracle_area_moments(const lmp_light *light, const double point[3], int bands,
                         const double q[3], double *moments) {
    static integral sum;
    sum.bands = bands;
    sum.q = q;
    sum.to = moments;
    memset(moments, 0, (size_t)bands * sizeof *moments);
    oracle_area(light, point, bands, add_legendre, &sum);
}

static void add_cosine(const double w[3], double solid_angle, void *user) {
    integral *sum = user;
    *sum->to += solid_angle * fmax(dot(w, sum->q), 0);
}

double oracle_area_irradiance(const lmp_light *light, const double point[3],
                              const double normal[3]) {
    static integral sum;
    double all = 0;
    sum.q = normal;
    sum.to = &all;
    integrate_area(light, point, 2, normal, add_cosine, &sum);
    return all;
}
