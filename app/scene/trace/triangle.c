/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/triangle.h"

#include "app/scene/trace/wide.h"

#include <math.h>

void triangle_rays_set(const float *const origin[3], const float *const direction[3], size_t count,
                       triangle_rays *rays) {
    for (size_t i = 0; i < count; i++) {
        int axis = 0;
        for (int c = 1; c < 3; c++)
            if (fabsf(direction[c][i]) > fabsf(direction[axis][i]))
                axis = c;
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        rays->axis[i] = axis;
        const float inverse = 1 / direction[axis][i];
        rays->shear[0][i] = inverse;
        rays->shear[1][i] = direction[next][i] * inverse;
        rays->shear[2][i] = direction[last][i] * inverse;
        rays->origin[0][i] = origin[axis][i];
        rays->origin[1][i] = origin[next][i];
        rays->origin[2][i] = origin[last][i];
    }
    rays->common = rays->axis[0];
    for (size_t i = 1; i < count; i++)
        if (rays->axis[i] != rays->axis[0])
            rays->common = -1;
}

/* A corner in the rays' space: its position along the rays' axis, and across it. */
typedef struct corner_lanes {
    triangle_lanes along, x, y;
} corner_lanes;

/* Returns the one of a, b and c that belongs to the axis. */
static inline float pick(int axis, float a, float b, float c) {
    return axis == 0 ? a : axis == 1 ? b : c;
}

/* Moves a corner into the rays' space. Indices have the width of addresses: with one that might
 * wrap around, lanes would be loaded one by one. */
static inline void move_corner(const triangle_rays *r, size_t first, size_t count, int axis,
                               const float *p, corner_lanes *corner) {
    for (size_t i = 0; i < count; i++) {
        const size_t k = first + i;
        const int own = axis >= 0 ? axis : r->axis[k];
        const float z = pick(own, p[0], p[1], p[2]) - r->origin[0][k];
        const float x = pick(own, p[1], p[2], p[0]) - r->origin[1][k];
        const float y = pick(own, p[2], p[0], p[1]) - r->origin[2][k];
        corner->along[i] = z;
        corner->x[i] = x - r->shear[1][k] * z;
        corner->y[i] = y - r->shear[2][k] * z;
    }
}

static inline void move_corners(const triangle_rays *r, size_t first, size_t count,
                                const float *const corners[3], corner_lanes at[3]) {
    for (int k = 0; k < 3; k++)
        switch (count == 1 ? r->axis[first] : r->common) {
        case 0:
            move_corner(r, first, count, 0, corners[k], &at[k]);
            break;
        case 1:
            move_corner(r, first, count, 1, corners[k], &at[k]);
            break;
        case 2:
            move_corner(r, first, count, 2, corners[k], &at[k]);
            break;
        default:
            move_corner(r, first, count, -1, corners[k], &at[k]);
        }
}

/* The corners' weights up to a common factor: twice the area between the ray and the opposite edge,
 * whose sign tells the ray's side of it. */
typedef struct side_lanes {
    triangle_lanes weights[3];
} side_lanes;

/* Computes the ray's side of the edge from a to b. Rounding is monotonic: the sign is right or the
 * result is 0. */
static inline float side_of(const corner_lanes *a, const corner_lanes *b, size_t i) {
    return b->x[i] * a->y[i] - b->y[i] * a->x[i];
}

/* Computes the side in double, in which the products, and so the sign, are exact. */
static float exact_side_of(const corner_lanes *a, const corner_lanes *b, size_t i) {
    return (float)((double)b->x[i] * (double)a->y[i] - (double)b->y[i] * (double)a->x[i]);
}

static inline int is_inside(float u, float v, float w) {
    return ((u >= 0) & (v >= 0) & (w >= 0)) | ((u <= 0) & (v <= 0) & (w <= 0));
}

/* Computes the sides of the three edges; returns whether any ray may hit. */
static inline bool find_sides(const corner_lanes at[3], size_t count, side_lanes *sides) {
    int any = 0, some = 0;
    for (size_t i = 0; i < count; i++) {
        const float u = side_of(&at[1], &at[2], i), v = side_of(&at[2], &at[0], i);
        const float w = side_of(&at[0], &at[1], i);
        sides->weights[0][i] = u;
        sides->weights[1][i] = v;
        sides->weights[2][i] = w;
        some |= (u == 0) | (v == 0) | (w == 0);
        any |= is_inside(u, v, w);
    }
    for (size_t i = 0; some && i < count; i++)
        for (int k = 0; k < 3; k++)
            if (sides->weights[k][i] == 0)
                sides->weights[k][i] = exact_side_of(&at[(k + 1) % 3], &at[(k + 2) % 3], i);
    return any;
}

/* Returns the rays that hit the triangle before they end. */
static inline uint32_t find_hits(const triangle_rays *rays, size_t first, size_t count,
                                 const corner_lanes at[3], const side_lanes *sides,
                                 const float *ends, triangle_hits *hits) {
    uint32_t before = 0;
    for (size_t i = 0; i < count; i++) {
        const float u = sides->weights[0][i], v = sides->weights[1][i], w = sides->weights[2][i];
        const float sum = u + v + w, scale = 1 / sum;
        const float mean = (u * at[0].along[i] + v * at[1].along[i] + w * at[2].along[i]) *
                           rays->shear[0][first + i];
        /* a triangle seen edge-on has sum 0, which makes the results NaN */
        hits->distance[i] = is_inside(u, v, w) ? mean * scale : NAN;
        hits->u[i] = v * scale;
        hits->v[i] = w * scale;
        hits->front[i] = (sum > 0) == (rays->shear[0][first + i] > 0);
        before |= (uint32_t)(hits->distance[i] <= ends[i]) << i;
    }
    return before;
}

static inline uint32_t test(const triangle_rays *rays, size_t first, size_t count,
                            const float *const corners[3], const float *ends, triangle_hits *hits) {
    corner_lanes at[3];
    side_lanes sides;
    move_corners(rays, first, count, corners, at);
    return find_sides(at, count, &sides) ? find_hits(rays, first, count, at, &sides, ends, hits)
                                         : 0;
}

/* Embree's packets have these widths; each gets loops of constant length. */
TRACE_WIDE uint32_t triangle_test(const triangle_rays *rays, size_t first, size_t count,
                                  const float *const corners[3], const float *ends,
                                  triangle_hits *hits) {
    switch (count) {
    case 1:
        return test(rays, first, 1, corners, ends, hits);
    case 4:
        return test(rays, first, 4, corners, ends, hits);
    case 8:
        return test(rays, first, 8, corners, ends, hits);
    case 16:
        return test(rays, first, 16, corners, ends, hits);
    default:
        return test(rays, first, count, corners, ends, hits);
    }
}
