/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_receivers.h"

#include "app/scene/instance.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* So many places are tried for each receiver that they could be. */
enum { TRIES = 2 };

/* Receivers are at least so much of their spacing apart, across their surface; off it a distance
 * counts more, because what lies above another surface needs its own. */
static const float apart = 0.8f, beside = 100;

/* A bound of memory and time: where all surfaces are near each other, such as leaves, the last ones
 * have none of their own and are read from surfels. */
#define RECEIVERS_MAX 250000

typedef struct spread {
    const scene *world;
    const trace_bvh *bvh;
    bool double_sided; /* the triangle */
    float least, most; /* the spacing */
    double area;       /* of small triangles so far, since the last place that was tried */
    size_t tried, capacity;
    uint32_t mask;          /* of hashes of cells, whose edge is the largest spacing */
    uint32_t *first, *next; /* 1 + a receiver, or 0: per hash the first; per receiver the next */
    transfer_surfels *receivers;
} spread;

/* --- cells ------------------------------------------------------------------------------------ */

static uint32_t hash_of(const spread *s, int32_t x, int32_t y, int32_t z) {
    return transfer_hash(x, y, z) & s->mask;
}

static int32_t cell_of(const spread *s, float x) {
    return (int32_t)floorf(x / s->most);
}

/* Whether two receivers are too near to each other. */
static bool collide(const lmp_transfer_surfel *a, const lmp_transfer_surfel *b) {
    const lmp_vec3 away = vec_sub(a->position, b->position);
    const float height = vec_dot(away, b->normal),
                near = apart / TRANSFER_REACH * fminf(a->radius, b->radius);
    return vec_dot(a->normal, b->normal) > 0.8f &&
           vec_dot(away, away) + beside * height * height < near * near;
}

static bool has_room(const spread *s, const lmp_transfer_surfel *new) {
    const int32_t x = cell_of(s, new->position.x), y = cell_of(s, new->position.y),
                  z = cell_of(s, new->position.z);
    for (int i = 0; i < 27; i++)
        for (uint32_t k = s->first[hash_of(s, x + i % 3 - 1, y + i / 3 % 3 - 1, z + i / 9 - 1)];
             k > 0; k = s->next[k - 1])
            if (collide(&s->receivers->at[k - 1], new))
                return false;
    return true;
}

static bool grow(spread *s) {
    const size_t capacity = 2 * s->capacity + 1024;
    lmp_transfer_surfel *at = realloc(s->receivers->at, capacity * sizeof *at);
    if (at)
        s->receivers->at = at;
    uint32_t *next = realloc(s->next, capacity * sizeof *next);
    if (next)
        s->next = next;
    if (at && next)
        s->capacity = capacity;
    return at && next;
}

static bool is_full(const spread *s) {
    return s->receivers->count == RECEIVERS_MAX;
}

/* Adds a receiver where it has room, unless it is buried. */
static bool add(spread *s, const lmp_transfer_surfel *new) {
    const size_t count = s->receivers->count;
    if (is_full(s) || !has_room(s, new) ||
        transfer_is_buried(s->world, s->bvh, new, s->tried, s->least / 10))
        return true;
    if (count == s->capacity && !grow(s))
        return false;
    const uint32_t hash = hash_of(s, cell_of(s, new->position.x), cell_of(s, new->position.y),
                                  cell_of(s, new->position.z));
    s->receivers->at[count] = *new;
    s->next[count] = s->first[hash];
    s->first[hash] = (uint32_t)++s->receivers->count;
    return true;
}

/* --- triangles -------------------------------------------------------------------------------- */

/* Returns the next point of a triangle. */
static lmp_vec3 draw_point(const spread *s, const lmp_vec3 corners[3]) {
    float weights[3];
    transfer_weights(s->tried, weights);
    return vec_add(corners[0], vec_add(vec_scale(vec_sub(corners[1], corners[0]), weights[1]),
                                       vec_scale(vec_sub(corners[2], corners[0]), weights[2])));
}

static float spacing_at(const spread *s, const lmp_transfer_surfel *place) {
    const float distance = transfer_distance(s->world, s->bvh, place, s->tried);
    return fminf(s->most, fmaxf(s->least, distance));
}

static bool spread_over(spread *s, const lmp_vec3 corners[3], lmp_vec3 normal);

/* Divides a triangle at the middle of its longest edge. */
static bool divide(spread *s, const lmp_vec3 corners[3], lmp_vec3 normal) {
    int from = 0;
    float longest = -1;
    for (int i = 0; i < 3; i++) {
        const lmp_vec3 edge = vec_sub(corners[(i + 1) % 3], corners[i]);
        if (vec_dot(edge, edge) > longest) {
            longest = vec_dot(edge, edge);
            from = i;
        }
    }
    const lmp_vec3 a = corners[from], b = corners[(from + 1) % 3], c = corners[(from + 2) % 3];
    const lmp_vec3 middle = vec_scale(vec_add(a, b), 0.5f);
    return spread_over(s, (lmp_vec3[3]) { c, a, middle }, normal) &&
           spread_over(s, (lmp_vec3[3]) { b, c, middle }, normal);
}

/* Tries places in a triangle: one if it is as small as what a place stands for, where surfaces are
 * so far away as they are there; else in its halves. */
static bool spread_over(spread *s, const lmp_vec3 corners[3], lmp_vec3 normal) {
    const double area = 0.5 * (double)vec_length(vec_cross(vec_sub(corners[1], corners[0]),
                                                           vec_sub(corners[2], corners[0])));
    const double smallest = (double)s->least * (double)s->least / TRIES;
    if (is_full(s) || (area < smallest && (s->area += area) < smallest))
        return true;
    s->area = 0;
    s->tried++;
    lmp_transfer_surfel place = { .position = draw_point(s, corners), .normal = normal };
    const float spacing = spacing_at(s, &place);
    if (TRIES * area > (double)spacing * (double)spacing)
        return divide(s, corners, normal);
    place.radius = TRANSFER_REACH * spacing;
    if (!add(s, &place))
        return false;
    place.normal = vec_scale(normal, -1);
    return !s->double_sided || add(s, &place);
}

static bool spread_all(spread *s) {
    const scene *world = s->world;
    for (size_t i = 0; i < world->instance_count; i++) {
        const uint32_t flags = world->materials[scene_instance_material(world, i)].flags;
        s->double_sided = flags & SCENE_DOUBLE_SIDED;
        for (uint32_t t = 0; t < scene_instance_triangles(world, i); t++) {
            float corners[3][3];
            lmp_vec3 normal, at[3];
            scene_triangle_positions(world, i, t, corners);
            if (!(transfer_face(corners, &normal) > 0))
                continue;
            for (int k = 0; k < 3; k++)
                at[k] = vec_load(corners[k]);
            if (!spread_over(s, at, normal))
                return false;
        }
    }
    return true;
}

bool transfer_receivers_make(const scene *world, const trace_bvh *bvh,
                             const transfer_surfels *surfels, transfer_surfels *receivers) {
    enum { HASHES = 1 << 16 };
    *receivers = (transfer_surfels) { .spacing = TRANSFER_PART * surfels->spacing };
    spread s = { .world = world,
                 .bvh = bvh,
                 .least = TRANSFER_PART_LEAST * surfels->spacing,
                 .most = TRANSFER_PART * surfels->spacing,
                 .mask = HASHES - 1,
                 .first = calloc(HASHES, sizeof *s.first),
                 .receivers = receivers };
    const bool ok = s.first && grow(&s) && (surfels->count == 0 || spread_all(&s));
    free(s.first);
    free(s.next);
    return ok;
}
