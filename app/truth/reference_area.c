/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_area.h"

/* --- flat areas ------------------------------------------------------------------------------- */

/* A flat area lies in the parallelogram origin + s a + t b with s and t in 0 … 1. Samples are
 * spread evenly over what of it is s + t <= 1, for a triangle, over a disk, or else over all of it;
 * those that a polygon does not cover bring no light. */
typedef struct flat_area {
    reference_vec origin, a, b, normal; /* the origin as seen from the light's position */
    double surface;                     /* over which samples are spread */
    bool triangle;
} flat_area;

static reference_vec corner_of(const reference_area *area, int i) {
    return area->corner[i % area->count];
}

static reference_vec normal_of_polygon(const reference_area *area) {
    reference_vec sum = { 0, 0, 0 };
    for (int i = 0; i < area->count; i++)
        sum = reference_add(sum, reference_cross(corner_of(area, i), corner_of(area, i + 1)));
    return reference_normalize(sum);
}

static void find_triangle(const reference_area *area, flat_area *flat) {
    flat->origin = corner_of(area, 0);
    flat->a = reference_subtract(corner_of(area, 1), flat->origin);
    flat->b = reference_subtract(corner_of(area, 2), flat->origin);
    flat->triangle = true;
}

/* Finds the smallest rectangle around a polygon along its first side. */
static void find_polygon(const reference_area *area, flat_area *flat) {
    const reference_vec normal = normal_of_polygon(area), first = corner_of(area, 0);
    const reference_vec x = reference_normalize(reference_subtract(corner_of(area, 1), first)),
                        y = reference_cross(normal, x);
    double low[2] = { (double)INFINITY, (double)INFINITY },
           high[2] = { -(double)INFINITY, -(double)INFINITY };
    for (int i = 0; i < area->count; i++) {
        const reference_vec off = reference_subtract(corner_of(area, i), first);
        const double at[2] = { reference_dot(off, x), reference_dot(off, y) };
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], at[k]);
            high[k] = fmax(high[k], at[k]);
        }
    }
    flat->origin =
        reference_add(first, reference_add(reference_scale(low[0], x), reference_scale(low[1], y)));
    flat->a = reference_scale(high[0] - low[0], x);
    flat->b = reference_scale(high[1] - low[1], y);
}

static flat_area flat_of(const reference_area *area) {
    flat_area flat = { .triangle = false };
    if (area->whole) {
        flat.origin = area->corner[0];
        flat.a = reference_subtract(area->corner[1], area->corner[0]);
        flat.b = reference_subtract(area->corner[3], area->corner[0]);
    } else if (area->disk) {
        const reference_vec normal = reference_normalize(area->axis),
                            x = reference_around(normal, 0, area->radius, 0),
                            y = reference_cross(normal, x);
        flat.origin = reference_scale(-1, reference_add(x, y));
        flat.a = reference_scale(2, x);
        flat.b = reference_scale(2, y);
    } else if (area->count == 3)
        find_triangle(area, &flat);
    else
        find_polygon(area, &flat);
    const reference_vec cross = reference_cross(flat.a, flat.b);
    flat.normal = reference_normalize(cross);
    flat.surface = reference_length(cross);
    if (flat.triangle)
        flat.surface /= 2;
    if (area->disk)
        flat.surface *= REFERENCE_PI / 4;
    return flat;
}

/* Counts how often the polygon winds around a point of its plane, by the angles of its sides. */
static bool winds_around(const reference_area *area, reference_vec normal, reference_vec at) {
    double angle = 0;
    for (int i = 0; i < area->count; i++) {
        const reference_vec from = reference_subtract(corner_of(area, i), at),
                            to = reference_subtract(corner_of(area, i + 1), at);
        angle += atan2(reference_dot(reference_cross(from, to), normal), reference_dot(from, to));
    }
    return angle > REFERENCE_PI;
}

static reference_area_hit meet_flat(const reference_area *area, reference_vec point,
                                    reference_vec direction) {
    const flat_area flat = flat_of(area);
    const reference_vec to = reference_subtract(area->position, point);
    reference_area_hit hit = { .distance = (double)INFINITY };
    const double cosine = -reference_dot(direction, flat.normal);
    const double height = -reference_dot(reference_add(to, flat.origin), flat.normal);
    if (cosine == 0 || !(height / cosine > 0))
        return hit;
    const double distance = height / cosine;
    const reference_vec at = reference_subtract(reference_scale(distance, direction), to),
                        off = reference_subtract(at, flat.origin);
    const double aa = reference_dot(flat.a, flat.a), bb = reference_dot(flat.b, flat.b);
    const double ab = reference_dot(flat.a, flat.b), det = aa * bb - ab * ab;
    const double oa = reference_dot(off, flat.a), ob = reference_dot(off, flat.b);
    const double s = (oa * bb - ob * ab) / det, t = (ob * aa - oa * ab) / det;
    const double x = 2 * s - 1, y = 2 * t - 1;
    const bool round = area->disk;
    if (!(s >= 0 && s <= 1 && t >= 0 && t <= 1) || (flat.triangle && s + t > 1) ||
        (round && x * x + y * y > 1))
        return hit;
    hit.density = distance * distance / (fabs(cosine) * flat.surface);
    if ((cosine > 0 || area->two_sided) &&
        (area->whole || round || flat.triangle || winds_around(area, flat.normal, at)))
        hit.distance = distance;
    return hit;
}

static reference_vec draw_flat(const reference_area *area, double u, double v) {
    const flat_area flat = flat_of(area);
    double s = u, t = v;
    if (area->disk) {
        s = (1 + sqrt(u) * cos(2 * REFERENCE_PI * v)) / 2;
        t = (1 + sqrt(u) * sin(2 * REFERENCE_PI * v)) / 2;
    } else if (flat.triangle && s + t > 1) {
        s = 1 - u;
        t = 1 - v;
    }
    return reference_add(flat.origin,
                         reference_add(reference_scale(s, flat.a), reference_scale(t, flat.b)));
}

static void see_flat(const reference_area *area, reference_area_view *view) {
    const flat_area flat = flat_of(area);
    const reference_vec half = reference_scale(0.5, reference_add(flat.a, flat.b));
    const double height = -reference_dot(reference_add(view->center, flat.origin), flat.normal);
    view->center = reference_add(view->center, reference_add(flat.origin, half));
    view->radius = fmax(reference_length(half), reference_length(reference_subtract(half, flat.a)));
    const double d2 = reference_dot(view->center, view->center);
    const double beside = sqrt(fmax(d2 - height * height, 0));
    const double gap = fmax(beside - view->radius, 0), near2 = height * height + gap * gap;
    view->shines = height > 0 || (area->two_sided && height < 0);
    view->solid_angle = fmin(flat.surface * fabs(height) / pow(near2, 1.5), 2 * REFERENCE_PI);
}

/* --- tubes ------------------------------------------------------------------------------------ */

/* A tube's axis as seen from a point. */
typedef struct tube_area {
    reference_vec middle, axis;
    double half, radius, surface;
} tube_area;

static tube_area tube_of(const reference_area *area, reference_vec point) {
    const reference_vec half = area->axis;
    tube_area tube = { reference_subtract(area->position, point), reference_normalize(half),
                       reference_length(half), area->radius, 0 };
    tube.surface = 4 * REFERENCE_PI * tube.radius * (tube.half + tube.radius);
    return tube;
}

/* Returns the point of the axis that is nearest to `at`. */
static reference_vec nearest_of_axis(const tube_area *tube, reference_vec at) {
    const double along = reference_dot(reference_subtract(at, tube->middle), tube->axis);
    const double held = fmax(-tube->half, fmin(along, tube->half));
    return reference_add(tube->middle, reference_scale(held, tube->axis));
}

/* The roots of a t² + 2 b t + c, in order; returns whether there are any. */
static bool solve(double a, double b, double c, double roots[2]) {
    const double square = b * b - a * c;
    if (!(a > 0) || !(square >= 0))
        return false;
    roots[0] = (-b - sqrt(square)) / a;
    roots[1] = (-b + sqrt(square)) / a;
    return true;
}

/* Adds the density of a point of the surface, if it lies ahead; keeps the nearest. */
static void meet_surface(const tube_area *tube, reference_vec direction, double distance,
                         reference_area_hit *hit) {
    const reference_vec at = reference_scale(distance, direction),
                        out = reference_subtract(at, nearest_of_axis(tube, at));
    const double cosine = fabs(reference_dot(direction, out)) / tube->radius;
    if (!(distance > 0) || !(cosine > 0))
        return;
    hit->density += distance * distance / (cosine * tube->surface);
    hit->distance = fmin(hit->distance, distance);
}

/* A ray meets the tube where it is the tube's radius from the axis: on the cylinder beside the
 * axis, or on a sphere past an end of it. */
static reference_area_hit meet_tube(const reference_area *area, reference_vec point,
                                    reference_vec direction) {
    const tube_area tube = tube_of(area, point);
    const double r2 = tube.radius * tube.radius, speed = reference_dot(direction, tube.axis);
    reference_area_hit hit = { .distance = (double)INFINITY };
    double roots[2];
    const reference_vec off = reference_subtract(
        tube.middle, reference_scale(reference_dot(tube.middle, tube.axis), tube.axis));
    if (solve(1 - speed * speed, -reference_dot(direction, off), reference_dot(off, off) - r2,
              roots))
        for (int k = 0; k < 2; k++) {
            const double along = roots[k] * speed - reference_dot(tube.middle, tube.axis);
            if (fabs(along) <= tube.half)
                meet_surface(&tube, direction, roots[k], &hit);
        }
    for (int end = -1; end <= 1; end += 2) {
        const reference_vec center =
            reference_add(tube.middle, reference_scale(end * tube.half, tube.axis));
        if (!solve(1, -reference_dot(direction, center), reference_dot(center, center) - r2, roots))
            continue;
        for (int k = 0; k < 2; k++) {
            const double along = roots[k] * speed - reference_dot(tube.middle, tube.axis);
            if (end * along > tube.half)
                meet_surface(&tube, direction, roots[k], &hit);
        }
    }
    return hit;
}

/* Equal lengths of the axis, with the rounded ends, have equal surfaces (Archimedes). */
static reference_vec draw_tube(const reference_area *area, double u, double v) {
    const tube_area tube = tube_of(area, (reference_vec) { 0, 0, 0 });
    const double along = (2 * u - 1) * (tube.half + tube.radius);
    const double past = fmax(fabs(along) - tube.half, 0);
    const double ring = sqrt((tube.radius - past) * (tube.radius + past));
    return reference_add(reference_scale(along, tube.axis),
                         reference_around(tube.axis, 0, ring, v));
}

static void see_tube(const reference_area *area, reference_vec point, reference_area_view *view) {
    const tube_area tube = tube_of(area, point);
    view->nearest = nearest_of_axis(&tube, (reference_vec) { 0, 0, 0 });
    const double near = fmax(reference_length(view->nearest), tube.radius);
    const double facing = tube.radius * (4 * tube.half + REFERENCE_PI * tube.radius);
    view->radius = tube.half + tube.radius;
    view->inside = reference_length(view->nearest) < tube.radius;
    view->shines = true;
    view->solid_angle = fmin(facing / (near * near), 2 * REFERENCE_PI);
}

/* --- all areas -------------------------------------------------------------------------------- */

reference_area_view reference_area_see(const reference_area *area, reference_vec point) {
    reference_area_view view = { .center = reference_subtract(area->position, point) };
    if (area->tube)
        see_tube(area, point, &view);
    else
        see_flat(area, &view);
    return view;
}

reference_vec reference_area_draw(const reference_area *area, reference_vec point, double u,
                                  double v) {
    const reference_vec to = reference_subtract(area->position, point);
    const reference_vec on = area->tube ? draw_tube(area, u, v) : draw_flat(area, u, v);
    return reference_normalize(reference_add(to, on));
}

reference_area_hit reference_area_meet(const reference_area *area, reference_vec point,
                                       reference_vec direction) {
    return area->tube ? meet_tube(area, point, direction) : meet_flat(area, point, direction);
}
