/* SPDX-License-Identifier: MIT */
/* flat.c - packs areas for the kernels. */
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

/* Packs what all flat areas have, given the distance of the farthest point from the centroid. The
 * points are centroid ± u ± v. */
static void pack(const lmpi_area *area, double radius, bool symmetric, lmpi_vector u, lmpi_vector v,
                 lmpi_kernel_flat *to) {
    int exponent = 0;
    frexp(radius, &exponent);
    const double per_unit = ldexp(1, -exponent),
                 whole = lmpi_vector_length(area->area) * per_unit * per_unit;
    to->position = area->light->position;
    to->per_unit = per_unit;
    to->two_sided = area->light->two_sided;
    to->radiance = area->light->radiance;
    put(area->axis, to->normal);
    put(lmpi_vector_scale(area->area, per_unit * per_unit), to->area);
    to->per_area = whole > 0 ? 1 / whole : 0;
    put(lmpi_vector_scale(area->count ? area->corner[0] : area->centroid, per_unit), to->corner);
    put(lmpi_vector_scale(area->centroid, per_unit), to->centroid);
    to->radius = radius * per_unit;
    to->far_for_irradiance = symmetric ? 20 : 200;
    to->far_for_lobes_a_band = symmetric ? 3.3 : 33;
    for (int i = 0; i < LMPI_FLAT_POINTS; i++) {
        const lmpi_vector p = along(along(area->centroid, i / 2 ? 1 : -1, u), i % 2 ? 1 : -1, v);
        put(lmpi_vector_scale(p, per_unit), to->point[i]);
    }
    to->each = whole / LMPI_FLAT_POINTS;
}

/* --- polygons --------------------------------------------------------------------------------- */

/* Finds u and v so that four points have the polygon's first and second moments: the columns of the
 * Cholesky factor. Of a polygon that is symmetric around its middle they have the third moments,
 * too, and of a rectangle they are Gauss' points. */
static void find_points(const lmpi_area *area, lmpi_vector *u, lmpi_vector *v) {
    const lmpi_vector x = lmpi_vector_unit(longest_side(area));
    const lmpi_vector y = lmpi_vector_cross(area->axis, x);
    const moments m = moments_of(area, x, y);
    const double xx = sqrt(fmax(m.xx, 0)), xy = xx > 0 ? m.xy / xx : 0,
                 yy = sqrt(fmax(m.yy - xy * xy, 0));
    *u = along(lmpi_vector_scale(x, xx), xy, y);
    *v = lmpi_vector_scale(y, yy);
}

/* The corners go the other way around than the light's, from the same one on, and the last is
 * repeated where their number is odd. */
static void find_edges(const lmpi_area *area, lmpi_kernel_polygon *to) {
    const double per_unit = to->flat.per_unit;
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

void lmpi_area_pack_polygon(const lmpi_area *area, lmpi_kernel_polygon *polygon) {
    double radius = 0;
    lmpi_vector u, v;
    for (int i = 0; i < area->count; i++)
        radius = fmax(radius, lmpi_vector_length(lmpi_vector_sub(area->corner[i], area->centroid)));
    find_points(area, &u, &v);
    pack(area, radius, is_symmetric(area, radius), u, v, &polygon->flat);
    find_edges(area, polygon);
}

/* --- disks ------------------------------------------------------------------------------------ */

void lmpi_area_pack_disk(const lmpi_area *area, lmpi_kernel_disk *disk) {
    const double pi = 3.14159265358979323846, root = sqrt(2 + sqrt(2)), radius = area->radius;
    /* by roots and products, which are the same everywhere: an angle of pi / 16 from node to node
     */
    const double step[2] = { sqrt(2 + root) / 2, sqrt(2 - root) / 2 };
    const lmpi_vector x = lmpi_vector_perpendicular(area->axis);
    const lmpi_vector y = lmpi_vector_cross(x, area->axis);
    double c = 1, s = 0;
    pack(area, radius, true, lmpi_vector_scale(x, radius / 2), lmpi_vector_scale(y, radius / 2),
         &disk->flat);
    const double r = disk->flat.radius;
    for (int i = 0; i < LMPI_DISK_NODES; i++) {
        const lmpi_vector across = along(lmpi_vector_scale(x, c), s, y),
                          on = along(lmpi_vector_scale(y, c), -s, x);
        put(lmpi_vector_scale(across, r), disk->node[i]);
        put(lmpi_vector_scale(on, 2 * pi / LMPI_DISK_NODES * r), disk->along[i]);
        const double next = c * step[0] - s * step[1];
        s = s * step[0] + c * step[1];
        c = next;
    }
}

/* --- tubes ------------------------------------------------------------------------------------ */

void lmpi_area_pack_tube(const lmpi_area *area, lmpi_kernel_tube *tube) {
    const double radius = (double)area->light->radius;
    int exponent = 0;
    frexp(area->half + radius, &exponent);
    const double per_unit = ldexp(1, -exponent);
    tube->position = area->light->position;
    tube->per_unit = per_unit;
    put(area->axis, tube->axis);
    tube->half = area->half * per_unit;
    tube->radius = radius * per_unit;
    tube->radiance = area->light->radiance;
}
