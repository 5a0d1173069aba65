/* SPDX-License-Identifier: MIT */
#include "app/scene/outline.h"

#include "app/scene/vector.h"

#include <stdbool.h>

/* The least area, and the most that a corner may be off the plane, relative to the longest way from
 * the first corner to another. */
static const double area_min = 1e-9, off_max = 1e-4;

/* A vector in double: products of lengths up to 1e17 overflow float32. */
typedef struct wide {
    double x, y, z;
} wide;

static wide way(lmp_vec3 from, lmp_vec3 to) {
    return (wide) { (double)to.x - (double)from.x, (double)to.y - (double)from.y,
                    (double)to.z - (double)from.z };
}

static wide cross(wide a, wide b) {
    return (wide) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static double dot(wide a, wide b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static double length(wide a) {
    return sqrt(dot(a, a));
}

/* The corners as seen from the first, the longest way being 1, and their area along the normal. */
typedef struct scaled_outline {
    int count;
    wide corner[LMP_LIGHT_CORNERS_MAX];
    wide area;
} scaled_outline;

static void scale_outline(const lmp_vec3 *corner, int count, scaled_outline *o) {
    double longest = 0;
    o->count = count;
    o->area = (wide) { 0, 0, 0 };
    for (int i = 0; i < o->count; i++) {
        o->corner[i] = way(corner[0], corner[i]);
        longest = fmax(longest, length(o->corner[i]));
    }
    for (int i = 0; i < o->count && longest > 0; i++)
        o->corner[i] =
            (wide) { o->corner[i].x / longest, o->corner[i].y / longest, o->corner[i].z / longest };
    for (int i = 1; i + 1 < o->count; i++) {
        const wide twice = cross(o->corner[i], o->corner[i + 1]);
        o->area.x += 0.5 * twice.x;
        o->area.y += 0.5 * twice.y;
        o->area.z += 0.5 * twice.z;
    }
}

/* Returns twice the signed area of a triangle of the outline's plane. */
static double twice_area(const scaled_outline *o, int a, int b, int c) {
    const wide to = { o->corner[b].x - o->corner[a].x, o->corner[b].y - o->corner[a].y,
                      o->corner[b].z - o->corner[a].z };
    const wide on = { o->corner[c].x - o->corner[a].x, o->corner[c].y - o->corner[a].y,
                      o->corner[c].z - o->corner[a].z };
    return dot(cross(to, on), o->area);
}

/* Whether the sides that begin at two corners cross inside both. */
static bool do_cross(const scaled_outline *o, int a, int b) {
    const int next_a = (a + 1) % o->count, next_b = (b + 1) % o->count;
    if (next_a == b || next_b == a)
        return false;
    return twice_area(o, a, next_a, b) * twice_area(o, a, next_a, next_b) < 0 &&
           twice_area(o, b, next_b, a) * twice_area(o, b, next_b, next_a) < 0;
}

const char *scene_outline_wrong(const lmp_vec3 *corner, int count) {
    scaled_outline o;
    scale_outline(corner, count, &o);
    const double area = length(o.area);
    for (int a = 0; a < o.count; a++)
        for (int b = a + 1; b < o.count; b++)
            if (do_cross(&o, a, b))
                return ".corners are in an order in which sides cross";
    if (!(area > area_min))
        return ".corners bound no area";
    for (int i = 0; i < o.count; i++)
        if (!(fabs(dot(o.corner[i], o.area)) <= off_max * area))
            return ".corners are not in a plane";
    return NULL;
}
