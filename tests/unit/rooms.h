/* SPDX-License-Identifier: MIT */
/* rooms.h - rooms of rectangles for the tests of transfers: their surfels, and what rays hit. */
#ifndef LAMPION_ROOMS_H
#define LAMPION_ROOMS_H

#include "tests/oracle/check.h"

#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>

/* --- vectors ---------------------------------------------------------------------------------- */

typedef struct room_vec {
    double x, y, z;
} room_vec;

static inline room_vec room_along(room_vec a, double s, room_vec b) {
    return (room_vec) { a.x + s * b.x, a.y + s * b.y, a.z + s * b.z };
}
static inline double room_dot(room_vec a, room_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline room_vec room_cross(room_vec a, room_vec b) {
    return (room_vec) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
static inline room_vec room_unit(room_vec a) {
    const room_vec none = { 0, 0, 0 };
    return room_along(none, 1 / sqrt(room_dot(a, a)), a);
}
static inline lmp_vec3 room_floats(room_vec a) {
    return (lmp_vec3) { (float)a.x, (float)a.y, (float)a.z };
}

/* --- rooms ------------------------------------------------------------------------------------ */

/* A rectangle with perpendicular edges, seen from the side to which u x v points. */
typedef struct room_rectangle {
    room_vec corner, u, v;
    double albedo;
    int columns, rows; /* of its surfels */
    size_t first;      /* surfel */
} room_rectangle;

enum { ROOM_RECTANGLES = 32 };
typedef struct room_model {
    room_rectangle rectangles[ROOM_RECTANGLES];
    int count;
    size_t surfel_count;
} room_model;

static inline room_vec room_normal(const room_rectangle *r) {
    return room_unit(room_cross(r->u, r->v));
}

/* Adds a rectangle whose surfels are about `spacing` apart. */
static inline void room_add(room_model *room, room_vec corner, room_vec u, room_vec v,
                            double albedo, double spacing) {
    room_rectangle r = { corner, u, v, albedo, 0, 0, room->surfel_count };
    assert_true(room->count < ROOM_RECTANGLES);
    r.columns = (int)fmax(1, round(sqrt(room_dot(u, u)) / spacing));
    r.rows = (int)fmax(1, round(sqrt(room_dot(v, v)) / spacing));
    room->surfel_count += (size_t)r.columns * (size_t)r.rows;
    room->rectangles[room->count++] = r;
}

/* Adds the six sides of a box, seen from inside or from outside. */
static inline void room_add_box(room_model *room, room_vec low, room_vec high, bool inside,
                                double albedo, double spacing) {
    const room_vec x = { high.x - low.x, 0, 0 }, y = { 0, high.y - low.y, 0 },
                   z = { 0, 0, high.z - low.z };
    const room_vec edges[3] = { x, y, z };
    for (int a = 0; a < 3; a++) {
        const room_vec u = edges[(a + 1) % 3], v = edges[(a + 2) % 3];
        const room_vec far = room_along(low, 1, edges[a]);
        room_add(room, inside ? low : far, u, v, albedo, spacing);
        room_add(room, inside ? far : low, v, u, albedo, spacing);
    }
}

/* --- rays ------------------------------------------------------------------------------------- */

typedef struct room_hit {
    double distance; /* INFINITY if nothing is hit */
    uint32_t source; /* the surfel, or LMP_TRANSFER_NONE */
} room_hit;

/* Returns the surfel of a rectangle whose cell has the fractions s and t of its edges. */
static inline uint32_t room_cell(const room_rectangle *r, double s, double t) {
    const int column = (int)fmin(s * r->columns, r->columns - 1);
    const int row = (int)fmin(t * r->rows, r->rows - 1);
    return (uint32_t)(r->first + (size_t)row * (size_t)r->columns + (size_t)column);
}

static inline room_hit room_cast(const room_model *room, room_vec from, room_vec direction) {
    room_hit nearest = { (double)INFINITY, LMP_TRANSFER_NONE };
    for (int i = 0; i < room->count; i++) {
        const room_rectangle *r = &room->rectangles[i];
        const room_vec normal = room_normal(r);
        const double toward = room_dot(direction, normal);
        const double height = room_dot(room_along(r->corner, -1, from), normal);
        const double distance = height / toward;
        if (toward == 0 || !(distance > 1e-6 && distance < nearest.distance))
            continue;
        const room_vec at = room_along(room_along(from, distance, direction), -1, r->corner);
        const double s = room_dot(at, r->u) / room_dot(r->u, r->u);
        const double t = room_dot(at, r->v) / room_dot(r->v, r->v);
        if (s >= 0 && s <= 1 && t >= 0 && t <= 1)
            nearest = (room_hit) { distance, toward < 0 ? room_cell(r, s, t) : LMP_TRANSFER_NONE };
    }
    return nearest;
}

/* Whether nothing stands between two points. */
static inline bool room_sees(const room_model *room, room_vec from, room_vec to) {
    const room_vec way = room_along(to, -1, from);
    const double length = sqrt(room_dot(way, way));
    return length < 1e-6 || room_cast(room, from, room_unit(way)).distance >= length * (1 - 1e-6);
}

/* Returns direction k of a sequence that is distributed as the cosine around a normal: the points
 * of Roberts' sequence R2 in the unit square, shifted at random by (u, v). */
static inline room_vec room_cosine_direction(room_vec normal, size_t k, double u, double v) {
    const double x = u + 0.7548776662466927 * (double)k, y = v + 0.5698402909980532 * (double)k;
    const double sin2 = x - floor(x), azimuth = 6.283185307179586 * y;
    const room_vec other = fabs(normal.x) < 0.5 ? (room_vec) { 1, 0, 0 } : (room_vec) { 0, 1, 0 };
    const room_vec a = room_unit(room_cross(normal, other)), b = room_cross(normal, a);
    const room_vec none = { 0, 0, 0 };
    const room_vec up = room_along(none, sqrt(1 - sin2), normal);
    return room_along(room_along(up, sqrt(sin2) * cos(azimuth), a), sqrt(sin2) * sin(azimuth), b);
}

/* --- transfers -------------------------------------------------------------------------------- */

/* The surfels of a room and what their rays hit; the caller frees the arrays with room_free. */
typedef struct room_lists {
    lmp_transfer_surfel *surfels;
    uint32_t *hits, *links;
    size_t ray_count, link_count;
} room_lists;

static inline void *room_allocate(size_t size) {
    void *memory = malloc(size + 1);
    assert_non_null(memory);
    return memory;
}

/* Returns where surfel `column`, `row` of a rectangle is, a little above it, where its rays
 * start. */
static inline room_vec room_center(const room_rectangle *r, int column, int row) {
    const room_vec along_u = room_along(r->corner, (column + 0.5) / r->columns, r->u);
    return room_along(room_along(along_u, (row + 0.5) / r->rows, r->v), 1e-5, room_normal(r));
}

/* Finds the surfels near surfel i, on its rectangle, that are seen from it. */
static inline void room_link(const room_model *room, const room_rectangle *r,
                             const room_lists *lists, size_t i) {
    uint32_t *links = lists->links + i * lists->link_count;
    const int column = (int)(i - r->first) % r->columns, row = (int)(i - r->first) / r->columns;
    size_t count = 0;
    for (int y = row - 2; y <= row + 2; y++)
        for (int x = column - 2; x <= column + 2; x++) {
            const bool there = x >= 0 && y >= 0 && x < r->columns && y < r->rows;
            if (there && (x != column || y != row) && count < lists->link_count &&
                room_sees(room, room_center(r, column, row), room_center(r, x, y)))
                links[count++] = (uint32_t)r->first + (uint32_t)(y * r->columns + x);
        }
    while (count < lists->link_count)
        links[count++] = LMP_TRANSFER_NONE;
}

/* Makes surfels that points up to `reach` spacings away read. */
static inline room_lists room_make_lists(const room_model *room, size_t ray_count,
                                         size_t link_count, double reach) {
    room_lists lists = { room_allocate(room->surfel_count * sizeof *lists.surfels),
                         room_allocate(room->surfel_count * ray_count * sizeof *lists.hits),
                         room_allocate(room->surfel_count * link_count * sizeof *lists.links),
                         ray_count, link_count };
    for (int n = 0; n < room->count; n++) {
        const room_rectangle *r = &room->rectangles[n];
        const room_vec normal = room_normal(r);
        const float albedo = (float)r->albedo;
        const double spacing =
            fmax(sqrt(room_dot(r->u, r->u)) / r->columns, sqrt(room_dot(r->v, r->v)) / r->rows);
        for (int c = 0; c < r->columns * r->rows; c++) {
            const size_t i = r->first + (size_t)c;
            const room_vec at = room_center(r, c % r->columns, c / r->columns);
            lists.surfels[i] = (lmp_transfer_surfel) { room_floats(at),
                                                       room_floats(normal),
                                                       { albedo, albedo, albedo },
                                                       (float)(reach * spacing) };
            const double u = check_random(), v = check_random();
            for (size_t k = 0; k < ray_count; k++)
                lists.hits[i * ray_count + k] =
                    room_cast(room, at, room_cosine_direction(normal, k, u, v)).source;
            room_link(room, r, &lists, i);
        }
    }
    return lists;
}

static inline void room_free(room_lists *lists) {
    free(lists->surfels);
    free(lists->hits);
    free(lists->links);
}

static inline lmp_transfer *room_transfer(const room_model *room, const room_lists *lists) {
    const lmp_transfer_desc desc = { .surfels = lists->surfels,
                                     .surfel_count = room->surfel_count,
                                     .hits = lists->hits,
                                     .ray_count = lists->ray_count,
                                     .links = lists->links,
                                     .link_count = lists->link_count };
    lmp_transfer *transfer;
    assert_int_equal(lmp_transfer_create(NULL, &desc, &transfer), LMP_OK);
    return transfer;
}

#endif
