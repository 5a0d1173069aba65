/* SPDX-License-Identifier: MIT */
/* polygon.c - packs areas with corners for the kernels. */
#include "src/light/seen.h"

static_assert(LMPI_POLYGON_CORNERS >= LMP_LIGHT_CORNERS_MAX && LMPI_POLYGON_CORNERS % 2 == 0,
              "an even number of corners is made of any");

static void put(lmpi_vector v, double to[3]) {
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

static lmpi_vector along(lmpi_vector v, double factor, lmpi_vector w) {
    return lmpi_vector_add(v, lmpi_vector_scale(w, factor));
}

/* Second moments around the centroid, over the area, in a plane with axes x and y. */
typedef struct moments {
    double xx, xy, yy;
} moments;

static moments moments_of(const lmpi_area *area, lmpi_vector x, lmpi_vector y) {
    const double whole = 12 * lmpi_vector_length(area->area);
    moments sum = { 0, 0, 0 };
    for (int i = 0; i < area->count; i++) {
        const lmpi_vector a = lmpi_vector_sub(area->corner[i], area->centroid);
        const lmpi_vector b = lmpi_vector_sub(area->corner[(i + 1) % area->count], area->centroid);
        const double ax = lmpi_vector_dot(a, x), ay = lmpi_vector_dot(a, y),
                     bx = lmpi_vector_dot(b, x), by = lmpi_vector_dot(b, y);
        /* twice the area of the triangle of the centroid, a and b */
        const double twice = ax * by - ay * bx, each = whole > 0 ? twice / whole : 0;
        sum.xx += each * (ax * ax + ax * bx + bx * bx);
        sum.yy += each * (ay * ay + ay * by + by * by);
        sum.xy += each * (ax * ay + bx * by + (ax * by + bx * ay) / 2);
    }
    return sum;
}

static lmpi_vector longest_side(const lmpi_area *area) {
    lmpi_vector longest = { 0, 0, 0 };
    for (int i = 0; i < area->count; i++) {
        const lmpi_vector side =
            lmpi_vector_sub(area->corner[(i + 1) % area->count], area->corner[i]);
        if (lmpi_vector_dot(side, side) > lmpi_vector_dot(longest, longest))
            longest = side;
    }
    return longest;
}

/* Finds four points with the area's first and second moments, centroid ± u ± v where u and v are
 * the columns of the Cholesky factor. Of an area that is symmetric around its middle they have
 * the third moments, too, and of a rectangle they are Gauss' points. */
static void find_points(const lmpi_area *area, double per_unit, lmpi_kernel_polygon *to) {
    const lmpi_vector x = lmpi_vector_unit(longest_side(area));
    const lmpi_vector y = lmpi_vector_cross(area->axis, x);
    const moments m = moments_of(area, x, y);
    const double xx = sqrt(fmax(m.xx, 0)), xy = xx > 0 ? m.xy / xx : 0,
                 yy = sqrt(fmax(m.yy - xy * xy, 0));
    const lmpi_vector u = along(lmpi_vector_scale(x, xx), xy, y), v = lmpi_vector_scale(y, yy);
    for (int i = 0; i < LMPI_POLYGON_POINTS; i++) {
        const lmpi_vector p = along(along(area->centroid, i / 2 ? 1 : -1, u), i % 2 ? 1 : -1, v);
        put(lmpi_vector_scale(p, per_unit), to->point[i]);
    }
    to->each = lmpi_vector_length(area->area) * per_unit * per_unit / LMPI_POLYGON_POINTS;
}

/* The corners go the other way around than the light's, from the same one on, and the last is
 * repeated where their number is odd. */
static void find_edges(const lmpi_area *area, double per_unit, lmpi_kernel_polygon *to) {
    const int count = area->count, even = count + count % 2;
    lmpi_vector around[LMPI_POLYGON_CORNERS];
    for (int i = 0; i < even; i++)
        around[i] = area->corner[i < count ? (count - i) % count : 1];
    to->count = even;
    for (int i = 0; i < even; i++) {
        const lmpi_vector edge = lmpi_vector_sub(around[(i + 1) % even], around[i]);
        put(lmpi_vector_scale(around[i], per_unit), to->corner[i]);
        put(lmpi_vector_scale(edge, per_unit), to->edge[i]);
    }
}

/* Whether each corner lies opposite to another one, around the middle. */
static bool is_symmetric(const lmpi_area *area, double radius) {
    const int half = area->count / 2;
    bool symmetric = area->count % 2 == 0;
    for (int i = 0; i < half; i++) {
        const lmpi_vector both = lmpi_vector_add(area->corner[i], area->corner[half + i]);
        symmetric &= lmpi_vector_length(along(both, -2, area->centroid)) < 1e-6 * radius;
    }
    return symmetric;
}

void lmpi_area_pack(const lmpi_area *area, lmpi_kernel_polygon *polygon) {
    double radius = 0;
    int exponent = 0;
    for (int i = 0; i < area->count; i++)
        radius = fmax(radius, lmpi_vector_length(lmpi_vector_sub(area->corner[i], area->centroid)));
    frexp(radius, &exponent);
    const double per_unit = ldexp(1, -exponent), whole = lmpi_vector_length(area->area);
    const bool symmetric = is_symmetric(area, radius);
    polygon->position = area->light->position;
    polygon->per_unit = per_unit;
    polygon->two_sided = area->light->two_sided;
    polygon->radiance = area->light->radiance;
    put(area->axis, polygon->normal);
    put(lmpi_vector_scale(area->area, per_unit * per_unit), polygon->area);
    polygon->per_area = whole > 0 ? 1 / (whole * per_unit * per_unit) : 0;
    put(lmpi_vector_scale(area->centroid, per_unit), polygon->centroid);
    polygon->radius = radius * per_unit;
    polygon->far_for_irradiance = symmetric ? 20 : 200;
    polygon->far_for_lobes_a_band = symmetric ? 2.5 : 25;
    find_edges(area, per_unit, polygon);
    find_points(area, per_unit, polygon);
}
