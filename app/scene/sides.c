/* SPDX-License-Identifier: MIT */
#include "app/scene/sides.h"

#include "app/scene/joined.h"
#include "app/scene/leak.h"
#include "app/scene/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LEAK_MOST  0.125 /* of its inner light: what a body may lose by cracks and small holes */
#define PAIRS_MOST ((size_t)1 << 22)
#define NONE       UINT32_MAX

/* A connected component of the meshes; vertices at the same position are connected. */
typedef struct body {
    double middle[3], inside; /* inside: six times its signed volume; below 0 if it is clockwise */
    float low[3], high[3];
    size_t triangles, open; /* open: edges without a triangle on the other side */
    uint32_t mesh;          /* of its first triangle */
    bool closed, flips;
} body;

typedef struct sides {
    scene_vertex *vertices; /* of the meshes, from `first`, the lowest of their numbers */
    uint32_t first, vertex_count;
    uint32_t *indices;
    const scene_mesh *all;
    const uint32_t *meshes;
    size_t mesh_count, corner_count;
    uint32_t *same;   /* per vertex the first one at its position */
    uint32_t *joined; /* per vertex another of its body (union-find), then the body */
    body *bodies;
    size_t body_count;
} sides;

static uint32_t *corners_of(const sides *s, size_t mesh) {
    return s->indices + s->all[s->meshes[mesh]].first_index;
}

static uint32_t corner_count(const sides *s, size_t mesh) {
    return s->all[s->meshes[mesh]].index_count;
}

/* --- bodies ----------------------------------------------------------------------------------- */

/* Numbers the bodies: `joined` becomes the number of each vertex's body. */
static bool number_bodies(sides *s) {
    memcpy(s->joined, s->same, s->vertex_count * sizeof *s->same);
    for (size_t m = 0; m < s->mesh_count; m++)
        for (uint32_t i = 0; i < corner_count(s, m); i += 3) {
            const uint32_t *const c = corners_of(s, m) + i;
            joined_join(s->joined, c[0] - s->first, c[1] - s->first);
            joined_join(s->joined, c[0] - s->first, c[2] - s->first);
        }
    s->body_count = joined_number(s->joined, s->vertex_count);
    s->bodies = calloc(s->body_count + 1, sizeof *s->bodies);
    return s->bodies != NULL;
}

static void measure_bounds(sides *s) {
    for (size_t i = 0; i < s->body_count; i++)
        for (int k = 0; k < 3; k++) {
            s->bodies[i].low[k] = INFINITY;
            s->bodies[i].high[k] = -INFINITY;
        }
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        body *const b = &s->bodies[s->joined[i]];
        for (int k = 0; k < 3; k++) {
            b->low[k] = fminf(b->low[k], s->vertices[i].position[k]);
            b->high[k] = fmaxf(b->high[k], s->vertices[i].position[k]);
        }
    }
    for (size_t i = 0; i < s->body_count; i++)
        for (int k = 0; k < 3; k++)
            s->bodies[i].middle[k] =
                0.5 * ((double)s->bodies[i].low[k] + (double)s->bodies[i].high[k]);
}

static void measure_insides(sides *s) {
    for (size_t m = 0; m < s->mesh_count; m++)
        for (uint32_t i = 0; i < corner_count(s, m); i += 3) {
            const uint32_t *const c = corners_of(s, m) + i;
            body *const b = &s->bodies[s->joined[c[0] - s->first]];
            double p[3][3];
            for (int k = 0; k < 3; k++)
                for (int axis = 0; axis < 3; axis++)
                    p[k][axis] =
                        (double)s->vertices[c[k] - s->first].position[axis] - b->middle[axis];
            for (int axis = 0; axis < 3; axis++) {
                const int d = (axis + 1) % 3, e = (axis + 2) % 3;
                b->inside += p[0][axis] * (p[1][d] * p[2][e] - p[1][e] * p[2][d]);
            }
            if (b->triangles++ == 0)
                b->mesh = s->meshes[m];
        }
}

/* --- open edges ------------------------------------------------------------------------------- */

typedef struct edge {
    uint32_t low, high; /* vertices; NONE: an empty slot */
    int32_t ways;       /* uses from low to high, minus those from high to low */
} edge;

/* Counts for each body the edges that are not used equally often in both directions. */
static bool count_open_edges(sides *s) {
    const size_t slots = joined_slots(s->corner_count);
    edge *const table = malloc(slots * sizeof *table);
    if (!table)
        return false;
    memset(table, 0xff, slots * sizeof *table);
    for (size_t m = 0; m < s->mesh_count; m++)
        for (uint32_t i = 0; i < corner_count(s, m); i++) {
            const uint32_t *const c = corners_of(s, m) + i / 3 * 3;
            const uint32_t from = s->same[c[i % 3] - s->first];
            const uint32_t to = s->same[c[(i + 1) % 3] - s->first];
            if (from == to)
                continue;
            const uint32_t low = from < to ? from : to, high = from < to ? to : from;
            uint64_t hash = (uint64_t)high << 32 | low;
            size_t slot = random_bits(&hash) & (slots - 1);
            while (table[slot].low != NONE && !(table[slot].low == low && table[slot].high == high))
                slot = (slot + 1) & (slots - 1);
            if (table[slot].low == NONE)
                table[slot] = (edge) { .low = low, .high = high };
            table[slot].ways += from < to ? 1 : -1;
        }
    for (size_t i = 0; i < slots; i++)
        if (table[i].low != NONE)
            s->bodies[s->joined[table[i].low]].open += (size_t)abs(table[i].ways);
    free(table);
    return true;
}

/* --- closed bodies ---------------------------------------------------------------------------- */

/* Copies the triangles to `sorted`, body after body; end[b + 1] becomes where those of body b end,
 * and end[0] is 0. */
static void sort_triangles(const sides *s, size_t *end, leak_triangle *sorted) {
    end[0] = end[1] = 0;
    for (size_t i = 1; i < s->body_count; i++)
        end[i + 1] = end[i] + s->bodies[i - 1].triangles;
    for (size_t m = 0; m < s->mesh_count; m++)
        for (uint32_t i = 0; i < corner_count(s, m); i += 3) {
            const uint32_t *const c = corners_of(s, m) + i;
            leak_triangle *const to = &sorted[end[s->joined[c[0] - s->first] + 1]++];
            for (int k = 0; k < 3; k++)
                memcpy(to->corner[k], s->vertices[c[k] - s->first].position, sizeof to->corner[k]);
        }
}

/* Finds which bodies are closed: those without open edges, and those that hold the light on their
 * inner side. How many edges are open tells nothing: a fine sheet has few of them, and a closed
 * body whose vertices do not quite meet has many. Returns false if memory ran out. */
static bool find_closed(sides *s) {
    size_t *const end = malloc((s->body_count + 2) * sizeof *end);
    leak_triangle *const sorted = malloc((s->corner_count / 3 + 1) * sizeof *sorted);
    const bool ok = end && sorted && count_open_edges(s);
    if (ok)
        sort_triangles(s, end, sorted);
    for (size_t i = 0; ok && i < s->body_count; i++) {
        body *const b = &s->bodies[i];
        b->closed = b->open == 0 || leak_part(sorted + end[i], b->triangles,
                                              b->inside < 0.0 ? 1 : -1, LEAK_MOST) <= LEAK_MOST;
    }
    free(end);
    free(sorted);
    return ok;
}

/* --- the decision ----------------------------------------------------------------------------- */

static bool holds(const body *outer, const body *inner) {
    for (int k = 0; k < 3; k++)
        if (!(outer->low[k] < inner->low[k] && inner->high[k] < outer->high[k]))
            return false;
    return true;
}

/* Whether a body stands in a room, whose floor, walls and ceiling it may touch. What is as large as
 * the room along two axes, such as a lid, is rather a part of it. */
static bool houses(const body *room, const body *inner) {
    int equal = 0;
    for (int k = 0; k < 3; k++) {
        if (!(room->low[k] <= inner->low[k] && inner->high[k] <= room->high[k]))
            return false;
        equal += room->low[k] == inner->low[k] && inner->high[k] == room->high[k];
    }
    return equal < 2;
}

/* Whether a clockwise body is intended: a room with something in it, or a hollow. */
static bool is_meant(const sides *s, const body *b) {
    for (size_t i = 0; i < s->body_count; i++) {
        const body *const other = &s->bodies[i];
        if (other->inside > 0.0 && other->closed &&
            (houses(b, other) || (other->mesh == b->mesh && holds(other, b))))
            return true;
    }
    return false;
}

static void decide(sides *s, size_t clockwise) {
    size_t flipped = 0, right = 0;
    for (size_t i = 0; i < s->body_count; i++) {
        body *const b = &s->bodies[i];
        if (!b->closed)
            continue;
        b->flips = b->inside < 0.0 && (clockwise * s->body_count > PAIRS_MOST || !is_meant(s, b));
        *(b->flips ? &flipped : &right) += b->triangles;
    }
    for (size_t i = 0; i < s->body_count; i++)
        if (flipped > right && !s->bodies[i].closed)
            s->bodies[i].flips = true;
}

static void flip(sides *s) {
    for (size_t m = 0; m < s->mesh_count; m++)
        for (uint32_t i = 0; i < corner_count(s, m); i += 3) {
            uint32_t *const c = corners_of(s, m) + i;
            if (s->bodies[s->joined[c[0] - s->first]].flips) {
                const uint32_t second = c[1];
                c[1] = c[2];
                c[2] = second;
            }
        }
    for (uint32_t i = 0; i < s->vertex_count; i++)
        if (s->bodies[s->joined[i]].flips) {
            for (int k = 0; k < 3; k++)
                s->vertices[i].normal[k] = -s->vertices[i].normal[k];
            s->vertices[i].tangent[3] = -s->vertices[i].tangent[3];
        }
}

/* Finds the range of vertices that the meshes use. */
static void find_vertices(sides *s, scene_builder *builder) {
    uint32_t most = 0;
    s->first = NONE;
    for (size_t m = 0; m < s->mesh_count; m++) {
        s->corner_count += corner_count(s, m);
        for (uint32_t i = 0; i < corner_count(s, m); i++) {
            const uint32_t vertex = corners_of(s, m)[i];
            s->first = vertex < s->first ? vertex : s->first;
            most = vertex > most ? vertex : most;
        }
    }
    if (s->first == NONE)
        return;
    s->vertex_count = most - s->first + 1;
    s->vertices = (scene_vertex *)builder_items(builder, BLOB_VERTICES) + s->first;
}

/* Finds the bodies; where the meshes have no vertices, there are none. sides_free is due in any
 * case. */
static bool find_bodies(sides *s, scene_builder *builder, const uint32_t *meshes, size_t count) {
    *s = (sides) { .indices = builder_items(builder, BLOB_INDICES),
                   .all = builder_items(builder, BLOB_MESHES),
                   .meshes = meshes,
                   .mesh_count = count };
    find_vertices(s, builder);
    if (s->vertex_count == 0)
        return true;
    s->same = malloc(s->vertex_count * sizeof *s->same);
    s->joined = malloc(s->vertex_count * sizeof *s->joined);
    if (!s->same || !s->joined || !joined_positions(s->vertices, s->vertex_count, s->same) ||
        !number_bodies(s))
        return false;
    measure_bounds(s);
    measure_insides(s);
    return true;
}

static void sides_free(sides *s) {
    free(s->same);
    free(s->joined);
    free(s->bodies);
}

bool sides_turn_outwards(scene_builder *builder, const uint32_t *meshes, size_t count) {
    sides s;
    bool ok = find_bodies(&s, builder, meshes, count);
    size_t clockwise = 0;
    for (size_t i = 0; ok && i < s.body_count; i++)
        clockwise += s.bodies[i].inside < 0.0;
    ok = ok && (clockwise == 0 || find_closed(&s));
    if (ok && clockwise > 0) {
        decide(&s, clockwise);
        flip(&s);
    }
    sides_free(&s);
    return ok;
}

bool sides_find(scene_builder *builder, uint32_t mesh, sides_of *found) {
    sides s;
    const bool ok = find_bodies(&s, builder, &mesh, 1) && find_closed(&s);
    for (uint32_t i = 0; ok && i < corner_count(&s, 0); i += 3) {
        const body *const b = &s.bodies[s.joined[corners_of(&s, 0)[i] - s.first]];
        found[i / 3] = !b->closed ? SIDES_OPEN : b->inside < 0.0 ? SIDES_INWARD : SIDES_OUTWARD;
    }
    sides_free(&s);
    return ok;
}
