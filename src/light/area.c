/* SPDX-License-Identifier: MIT */
/* area.c - lights that are areas: flat ones, disks and polygons, and tubes. */
#include "src/light/area.h"

#include "src/light/seen.h"
#include "src/sphere/sphere.h"

#include <string.h>

static const double pi = 3.14159265358979323846;

static double larger(double a, double b) {
    return a > b ? a : b;
}

/* --- flat areas ------------------------------------------------------------------------------- */

/* Sums the triangles of a polygon's first corner and its sides, signed by the side they turn to. */
static void measure_polygon(lmpi_area *flat) {
    const lmpi_vector first = flat->corner[0];
    lmpi_vector moment = { 0, 0, 0 };
    double whole = 0;
    flat->area = moment;
    for (int i = 1; i + 1 < flat->count; i++) {
        const lmpi_vector a = lmpi_vector_sub(flat->corner[i], first),
                          b = lmpi_vector_sub(flat->corner[i + 1], first);
        flat->area = lmpi_vector_add(flat->area, lmpi_vector_scale(lmpi_vector_cross(a, b), 0.5));
    }
    for (int i = 1; i + 1 < flat->count; i++) {
        const lmpi_vector a = lmpi_vector_sub(flat->corner[i], first),
                          b = lmpi_vector_sub(flat->corner[i + 1], first);
        const double part = lmpi_vector_dot(lmpi_vector_cross(a, b), flat->area);
        whole += part;
        moment = lmpi_vector_add(moment, lmpi_vector_scale(lmpi_vector_add(a, b), part / 3));
    }
    for (int i = 0; i < flat->count; i++)
        flat->radius = larger(flat->radius, lmpi_vector_length(flat->corner[i]));
    flat->centroid = lmpi_vector_add(first, lmpi_vector_scale(moment, whole > 0 ? 1 / whole : 0));
}

void lmpi_area_prepare(const lmp_light *light, lmpi_area *area) {
    assert(lmpi_is_light(light) && lmpi_light_is_area(light));
    area->light = light;
    if (lmpi_area_is_tube(light)) {
        const lmpi_vector half = lmpi_vector_of(light->half[0]);
        area->axis = lmpi_vector_unit(half);
        area->half = lmpi_vector_length(half);
        return;
    }
    area->radius = 0;
    area->count = lmpi_area_find_corners(light, area->corner);
    if (area->count > 0) {
        measure_polygon(area);
    } else {
        const lmpi_vector normal = lmpi_vector_unit(lmpi_vector_of(light->direction));
        area->radius = (double)light->radius;
        area->area = lmpi_vector_scale(normal, pi * area->radius * area->radius);
        area->centroid = (lmpi_vector) { 0, 0, 0 };
    }
    area->axis = lmpi_vector_unit(area->area);
}

static void outline_disk(lmpi_vector center, double radius, lmpi_loop *loop) {
    const lmpi_vector x = lmpi_vector_scale(lmpi_vector_perpendicular(loop->inner), radius);
    const lmpi_vector y = lmpi_vector_cross(loop->inner, x);
    lmpi_loop_add_arc(loop, center, x, y, 1);
    lmpi_loop_add_arc(loop, center, lmpi_vector_scale(x, -1), lmpi_vector_scale(y, -1), 1);
}

/* Follows the corners, or goes back where these are clockwise as seen from inside the sphere. */
static void outline_polygon(const lmpi_area *flat, lmpi_vector center, bool back, lmpi_loop *loop) {
    for (int i = 0; i < flat->count; i++) {
        const int next = (i + 1) % flat->count, last = flat->count - 1;
        const lmpi_vector a = flat->corner[back ? i : last - i],
                          b = flat->corner[back ? next : last - next];
        const lmpi_vector from = lmpi_vector_add(center, a), edge = lmpi_vector_sub(b, a);
        lmpi_loop_add_edge(loop, from, edge, lmpi_vector_cross(from, edge));
    }
}

/* --- what is seen ----------------------------------------------------------------------------- */

static void see_dirac(lmpi_vector to, double solid_angle, lmp_rgb radiance, lmpi_seen *seen) {
    const float each = (float)solid_angle;
    const lmp_vec3 z = { 0, 0, 1 };
    const bool there = lmpi_vector_dot(to, to) > 0;
    seen->is_loop = false;
    seen->cap =
        (lmp_cap) { .axis = there ? lmpi_vector_rounded(lmpi_vector_unit(to)) : z,
                    .strength = { radiance.r * each, radiance.g * each, radiance.b * each } };
}

static void see_flat(const lmpi_area *flat, lmpi_vector to, lmpi_seen *seen) {
    const lmp_light *light = flat->light;
    const lmpi_vector plane = flat->count ? lmpi_vector_add(to, flat->corner[0]) : to;
    const lmpi_vector center = lmpi_vector_add(to, flat->centroid);
    const double height = -lmpi_vector_dot(flat->area, plane), d = lmpi_vector_length(center);
    if (!(height > 0 || (light->two_sided && height < 0)))
        see_dirac(to, 0, light->radiance, seen);
    else if (flat->radius <= LMPI_SEEN_DIRAC * d)
        see_dirac(center, fabs(lmpi_vector_dot(flat->area, center)) / (d * d * d), light->radiance,
                  seen);
    else {
        const bool back = height < 0;
        lmpi_loop *loop = &seen->loop;
        seen->is_loop = true;
        seen->radiance = light->radiance;
        lmpi_loop_begin(loop, lmpi_vector_scale(flat->axis, back ? 1 : -1));
        if (flat->count)
            outline_polygon(flat, to, back, loop);
        else
            outline_disk(to, flat->radius, loop);
        lmpi_loop_end(loop);
    }
}

/* A tube as seen from beside it: unit vectors along its axis, from the viewer straight to the line
 * of the axis, and across both; the middle, half its length, the distance of that line, the radius.
 * All that is seen is made from these, or far beyond an end it would lose its digits. */
typedef struct tube_area {
    lmpi_vector axis, toward, across;
    double along, half, distance, radius;
} tube_area;

static lmpi_vector tube_vector(const tube_area *tube, double along, double toward, double across) {
    return lmpi_vector_add(lmpi_vector_scale(tube->axis, along),
                           lmpi_vector_add(lmpi_vector_scale(tube->toward, toward),
                                           lmpi_vector_scale(tube->across, across)));
}

static tube_area tube_of(const lmpi_area *area, lmpi_vector to) {
    tube_area tube = { .axis = area->axis,
                       .half = area->half,
                       .radius = (double)area->light->radius };
    tube.along = lmpi_vector_dot(to, tube.axis);
    const lmpi_vector rest = lmpi_vector_sub(to, lmpi_vector_scale(tube.axis, tube.along));
    tube.distance = lmpi_vector_length(rest);
    /* The second step removes what rounding leaves of the axis. */
    const double left = lmpi_vector_dot(rest, tube.axis);
    tube.toward = lmpi_vector_unit(lmpi_vector_sub(rest, lmpi_vector_scale(tube.axis, left)));
    tube.across = lmpi_vector_cross(tube.axis, tube.toward);
    return tube;
}

/* The tangent planes through the viewer have the poles sine toward ± cosine across. */
typedef struct tube_tangent {
    double sine, cosine;
} tube_tangent;

/* Appends the outline of the end at `sign` times half the length, from one tangent plane to the
 * other. */
static void outline_end(const tube_area *tube, tube_tangent tangent, double sign, lmpi_loop *loop) {
    const double along = tube->along + sign * tube->half, r2 = tube->radius * tube->radius;
    const double d2 = along * along + tube->distance * tube->distance, d = sqrt(d2);
    const double nearer = (d2 - r2) / d2, radius = tube->radius * sqrt(nearer);
    const lmpi_vector center = tube_vector(tube, along * nearer, tube->distance * nearer, 0);
    const lmpi_vector x = tube_vector(tube, sign * tube->distance / d, -sign * along / d, 0);
    const lmpi_vector y = lmpi_vector_scale(tube->across, -sign);
    /* Where a plane touches the end, in x and y, and half the angle to there from x. */
    const double u = tangent.sine * sign * along / d, v = tangent.cosine;
    const double cosine = u / sqrt(u * u + v * v);
    const double c = sqrt((1 + cosine) / 2), s = sqrt((1 - cosine) / 2);
    for (int side = -1; side <= 1; side += 2) {
        const lmpi_vector middle = lmpi_vector_add(lmpi_vector_scale(x, c * radius),
                                                   lmpi_vector_scale(y, side * s * radius));
        const lmpi_vector beside = lmpi_vector_sub(lmpi_vector_scale(y, c * radius),
                                                   lmpi_vector_scale(x, side * s * radius));
        lmpi_loop_add_arc(loop, center, middle, beside, s / (1 + c));
    }
}

/* Appends the edge that begins at the end of this sign, in the tangent plane of the same one. */
static void outline_side(const tube_area *tube, tube_tangent tangent, double sign,
                         lmpi_loop *loop) {
    const double r = tube->radius, length = -2 * sign * tube->half;
    const double away = tube->distance * tangent.cosine;
    const lmpi_vector from =
        tube_vector(tube, tube->along + sign * tube->half, tube->distance - r * tangent.sine,
                    -sign * r * tangent.cosine);
    const lmpi_vector pole = tube_vector(tube, 0, tangent.sine, sign * tangent.cosine);
    lmpi_loop_add_edge(loop, from, lmpi_vector_scale(tube->axis, length),
                       lmpi_vector_scale(pole, 2 * tube->half * away));
}

static void outline_tube(const tube_area *tube, lmpi_loop *loop) {
    const double d = tube->distance, r = tube->radius;
    const tube_tangent tangent = { r / d, sqrt((d - r) * (d + r)) / d };
    outline_side(tube, tangent, -1, loop);
    outline_end(tube, tangent, 1, loop);
    outline_side(tube, tangent, 1, loop);
    outline_end(tube, tangent, -1, loop);
}

/* Sees a sphere by the rules of sphere.h, closer to its surface than float32 can tell its distance.
 */
static void see_sphere(lmpi_vector to, double radius, lmp_rgb radiance, lmpi_seen *seen) {
    const double d = lmpi_vector_length(to), far = larger(d, radius),
                 near = d < radius ? d : radius;
    const double ratio = far > 0 ? near / far : 0;
    const double cosine = far > 0 ? sqrt((far - near) * (far + near)) / far : 1;
    const bool inside = d < radius;
    const double sin2 = ratio * ratio;
    see_dirac(inside ? lmpi_vector_scale(to, -1) : to, inside ? -pi * sin2 : pi * sin2, radiance,
              seen);
    seen->cap.sin2 = (float)sin2;
    seen->cap.one_minus_cos = (float)(sin2 / (1 + cosine));
    if (inside)
        seen->cap.ambient = radiance;
}

static void see_tube(const lmpi_area *area, lmpi_vector to, lmpi_seen *seen) {
    const lmp_light *light = area->light;
    const tube_area tube = tube_of(area, to);
    const double d = lmpi_vector_length(to), r = tube.radius;
    const double nearest = fmin(fmax(0, tube.along - tube.half), tube.along + tube.half);
    const lmpi_vector nearest_point = tube_vector(&tube, nearest, tube.distance, 0);
    if (!(tube.distance > r && tube.half > 0)) {
        /* From beyond an end its sphere is all that is seen; inside, the nearest one stands for it.
         */
        see_sphere(nearest_point, r, light->radiance, seen);
    } else if (tube.half + r <= LMPI_SEEN_DIRAC * d) {
        see_dirac(to, r * (4 * tube.half * tube.distance / d + pi * r) / (d * d), light->radiance,
                  seen);
    } else {
        seen->is_loop = true;
        seen->radiance = light->radiance;
        lmpi_loop_begin(&seen->loop, lmpi_vector_unit(nearest_point));
        outline_tube(&tube, &seen->loop);
        lmpi_loop_end(&seen->loop);
    }
}

void lmpi_area_see(const lmpi_area *area, lmp_vec3 point, lmpi_seen *seen) {
    const lmp_light *light = area->light;
    const lmpi_vector to = lmpi_vector_sub(lmpi_vector_of(light->position), lmpi_vector_of(point));
    if (lmpi_area_is_tube(light))
        see_tube(area, to, seen);
    else
        see_flat(area, to, seen);
}

/* --- texels ----------------------------------------------------------------------------------- */

/* What area.glsl calls the shapes that have no corners. */
enum { TEXELS_DISK = 1, TEXELS_TUBE = 2 };

static void put_texel(lmpi_vector v, double w, float texel[4]) {
    const lmp_vec3 rounded = lmpi_vector_rounded(v);
    texel[0] = rounded.x, texel[1] = rounded.y, texel[2] = rounded.z;
    texel[3] = (float)w;
}

static void put_head(const lmp_light *area, lmpi_vector middle, int shape, double extent,
                     float (*texels)[4]) {
    const lmp_rgb radiance = area->radiance;
    put_texel(middle, area->two_sided ? -shape : shape, texels[0]);
    put_texel((lmpi_vector) { (double)radiance.r, (double)radiance.g, (double)radiance.b }, extent,
              texels[1]);
}

void lmp_light_copy_area_texels(const lmp_light *area, float *texels) {
    assert(lmpi_is_light(area) && lmpi_light_is_area(area));
    float(*to)[4] = (float(*)[4])texels;
    const lmpi_vector position = lmpi_vector_of(area->position);
    const double radius = (double)area->radius;
    memset(texels, 0, LMP_AREA_TEXELS * sizeof *to);
    if (lmpi_area_is_tube(area)) {
        const lmpi_vector half = lmpi_vector_of(area->half[0]);
        put_head(area, position, TEXELS_TUBE, lmpi_vector_length(half) + radius, to);
        put_texel(half, radius, to[2]);
        return;
    }
    lmpi_area flat;
    lmpi_area_prepare(area, &flat);
    double extent = flat.count ? 0 : radius;
    for (int i = 0; i < flat.count; i++) {
        const lmpi_vector corner = lmpi_vector_sub(flat.corner[i], flat.centroid);
        extent = larger(extent, lmpi_vector_length(corner));
        put_texel(corner, 0, to[3 + i]);
    }
    put_head(area, lmpi_vector_add(position, flat.centroid), flat.count ? flat.count : TEXELS_DISK,
             extent, to);
    put_texel(flat.axis, flat.count ? 0 : radius, to[2]);
}

/* --- size ------------------------------------------------------------------------------------- */

lmpi_area_size lmpi_area_measure(const lmp_light *light) {
    if (lmpi_area_is_tube(light)) {
        const double r = (double)light->radius,
                     half = lmpi_vector_length(lmpi_vector_of(light->half[0]));
        return (lmpi_area_size) { r * (4 * half + pi * r), 4 * pi * r * (half + r), half + r };
    }
    lmpi_area flat;
    lmpi_area_prepare(light, &flat);
    const double area = lmpi_vector_length(flat.area);
    return (lmpi_area_size) { area, light->two_sided ? 2 * area : area, flat.radius };
}
