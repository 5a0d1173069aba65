/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/triangle.h"

#include "app/scene/trace/wide.h"

#include <math.h>

/* Returns the one of a, b and c that belongs to the axis. */
static inline float pick(int axis, float a, float b, float c) {
    return axis == 0 ? a : axis == 1 ? b : c;
}

static inline void set_rays(const float *const origin[3], const float *const direction[3],
                            size_t count, triangle_rays *rays) {
    const float *const px = origin[0], *const py = origin[1], *const pz = origin[2];
    const float *const dx = direction[0], *const dy = direction[1], *const dz = direction[2];
    int others = 0;
    for (size_t i = 0; i < count; i++) {
        const float x = fabsf(dx[i]), y = fabsf(dy[i]), z = fabsf(dz[i]);
        const int axis = z > (y > x ? y : x) ? 2 : y > x ? 1 : 0;
        const float inverse = 1 / pick(axis, dx[i], dy[i], dz[i]);
        rays->axis[i] = axis;
        rays->shear[0][i] = inverse;
        rays->shear[1][i] = pick(axis, dy[i], dz[i], dx[i]) * inverse;
        rays->shear[2][i] = pick(axis, dz[i], dx[i], dy[i]) * inverse;
        rays->origin[0][i] = pick(axis, px[i], py[i], pz[i]);
        rays->origin[1][i] = pick(axis, py[i], pz[i], px[i]);
        rays->origin[2][i] = pick(axis, pz[i], px[i], py[i]);
    }
    for (size_t i = 1; i < count; i++)
        others |= rays->axis[i] ^ rays->axis[0];
    rays->common = others ? -1 : rays->axis[0];
}

TRACE_WIDE void triangle_rays_set(const float *const origin[3], const float *const direction[3],
                                  size_t count, triangle_rays *rays) {
    if (count == TRIANGLE_LANES)
        set_rays(origin, direction, TRIANGLE_LANES, rays);
    else
        set_rays(origin, direction, count, rays);
}

/* A corner in a ray's space: its position along the ray's axis, and across it. */
typedef struct corner {
    float along, x, y;
} corner;

/* Moves the corner at p into the space of ray k; `turned` means that the coordinates of p are in
 * the order of the ray's axes already. */
static inline corner move_corner(const triangle_rays *r, size_t k, bool turned, const float *p) {
    const int axis = turned ? 0 : r->axis[k];
    const float along = pick(axis, p[0], p[1], p[2]) - r->origin[0][k];
    return (corner) { along,
                      pick(axis, p[1], p[2], p[0]) - r->origin[1][k] - r->shear[1][k] * along,
                      pick(axis, p[2], p[0], p[1]) - r->origin[2][k] - r->shear[2][k] * along };
}

/* For each ray, the corners' positions along its axis, and their weights up to a common factor:
 * twice the area between the ray and the opposite edge, whose sign tells the ray's side of it. */
typedef struct side_lanes {
    triangle_lanes along[3], weights[3];
} side_lanes;

/* Computes the ray's side of the edge from a to b. Rounding is monotonic: the sign is right or the
 * result is 0. */
static inline float side_of(corner a, corner b) {
    return b.x * a.y - b.y * a.x;
}

/* Computes the side in double, in which the products, and so the sign, are exact. */
static inline float exact_side_of(corner a, corner b) {
    return (float)((double)b.x * (double)a.y - (double)b.y * (double)a.x);
}

static inline int is_inside(float u, float v, float w) {
    return ((u >= 0) & (v >= 0) & (w >= 0)) | ((u <= 0) & (v <= 0) & (w <= 0));
}

/* Computes again the sides that are 0. */
static void find_exact_sides(const triangle_rays *rays, size_t first, size_t count, bool turned,
                             const float *const corners[3], side_lanes *sides) {
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            if (sides->weights[k][i] == 0)
                sides->weights[k][i] =
                    exact_side_of(move_corner(rays, first + i, turned, corners[(k + 1) % 3]),
                                  move_corner(rays, first + i, turned, corners[(k + 2) % 3]));
}

/* Computes the sides of the three edges; returns whether any ray may hit. */
static inline bool find_sides(const triangle_rays *rays, size_t first, size_t count, bool turned,
                              const float *const corners[3], side_lanes *sides) {
    int any = 0, some = 0;
    for (size_t i = 0; i < count; i++) {
        const corner a = move_corner(rays, first + i, turned, corners[0]);
        const corner b = move_corner(rays, first + i, turned, corners[1]);
        const corner c = move_corner(rays, first + i, turned, corners[2]);
        const float u = side_of(b, c), v = side_of(c, a), w = side_of(a, b);
        sides->along[0][i] = a.along;
        sides->along[1][i] = b.along;
        sides->along[2][i] = c.along;
        sides->weights[0][i] = u;
        sides->weights[1][i] = v;
        sides->weights[2][i] = w;
        some |= (u == 0) | (v == 0) | (w == 0);
        any |= is_inside(u, v, w);
    }
    if (some)
        find_exact_sides(rays, first, count, turned, corners, sides);
    return any;
}

/* Returns the rays that hit the triangle before they end. */
static inline uint32_t find_hits(const triangle_rays *rays, size_t first, size_t count,
                                 const side_lanes *sides, const float *ends, triangle_hits *hits) {
    uint32_t before = 0;
    for (size_t i = 0; i < count; i++) {
        const float u = sides->weights[0][i], v = sides->weights[1][i], w = sides->weights[2][i];
        const float sum = u + v + w, scale = 1 / sum;
        const float mean =
            (u * sides->along[0][i] + v * sides->along[1][i] + w * sides->along[2][i]) *
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
    const int axis = count == 1 ? rays->axis[first] : rays->common;
    float turned[3][3];
    side_lanes sides;
    for (int k = 0; axis >= 0 && k < 3; k++)
        for (int c = 0; c < 3; c++)
            turned[k][c] = corners[k][(axis + c) % 3];
    const float *const at[3] = { turned[0], turned[1], turned[2] };
    if (!(axis >= 0 ? find_sides(rays, first, count, true, at, &sides)
                    : find_sides(rays, first, count, false, corners, &sides)))
        return 0;
    return find_hits(rays, first, count, &sides, ends, hits);
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
