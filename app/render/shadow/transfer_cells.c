/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_cells.h"

#include "app/scene/vector.h"

#include <stdlib.h>

enum { FOUND_MAX = 32 };

/* Off the plane of the surface a distance counts so many times as much, squared: a point of a rug
 * is nearer to the rug's surfels than to those of the floor under it. */
#define BESIDE 400.0f

static transfer_cell cell_of(const transfer_cells *c, lmp_vec3 point) {
    return (transfer_cell) { (int32_t)floorf(point.x / c->size), (int32_t)floorf(point.y / c->size),
                             (int32_t)floorf(point.z / c->size) };
}

static uint32_t hash_of(const transfer_cells *c, transfer_cell at) {
    const uint32_t hash =
        (uint32_t)at.x * 0x9e3779b1u ^ (uint32_t)at.y * 0x85ebca6bu ^ (uint32_t)at.z * 0xc2b2ae35u;
    return (hash ^ hash >> 15) & c->mask;
}

static bool is_same(transfer_cell a, transfer_cell b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Sorts the surfels by their cells. */
static bool sort_surfels(transfer_surfels *s, transfer_cells *c) {
    lmp_transfer_surfel *sorted = malloc((s->count + 1) * sizeof *sorted);
    if (!sorted)
        return false;
    for (size_t i = 0; i < s->count; i++)
        c->begin[hash_of(c, cell_of(c, s->at[i].position))]++;
    for (uint32_t h = 1; h <= c->mask + 1; h++)
        c->begin[h] += c->begin[h - 1];
    /* begin[h] is where hash h ends, and falls to where it begins */
    for (size_t i = s->count; i-- > 0;)
        sorted[--c->begin[hash_of(c, cell_of(c, s->at[i].position))]] = s->at[i];
    free(s->at);
    s->at = sorted;
    for (size_t i = 0; i < s->count; i++)
        c->cell[i] = cell_of(c, s->at[i].position);
    return true;
}

bool transfer_cells_create(transfer_surfels *s, transfer_cells *c) {
    *c = (transfer_cells) { .surfels = s, .size = TRANSFER_NEAR * s->spacing, .mask = 1 };
    while (c->mask < s->count)
        c->mask = 2 * c->mask + 1;
    c->begin = calloc((size_t)c->mask + 2, sizeof *c->begin);
    c->cell = malloc((s->count + 1) * sizeof *c->cell);
    return c->begin && c->cell && sort_surfels(s, c);
}

void transfer_cells_free(transfer_cells *c) {
    free(c->begin);
    free(c->cell);
    *c = (transfer_cells) { .begin = NULL };
}

/* The nearest surfels so far. */
typedef struct search {
    const transfer_cells *cells;
    lmp_vec3 point, normal;
    float cosine;
    size_t capacity, count;
    uint32_t *found;
    float distance2[FOUND_MAX];
} search;

/* Considers surfel i, if it belongs to the cell. */
static void consider(search *s, transfer_cell from, uint32_t i) {
    const transfer_cells *c = s->cells;
    const lmp_transfer_surfel *at = &c->surfels->at[i];
    const lmp_vec3 away = vec_sub(at->position, s->point);
    const float height = vec_dot(away, s->normal), straight2 = vec_dot(away, away);
    const float distance2 = straight2 + BESIDE * height * height;
    const bool full = s->count == s->capacity;
    if (!(straight2 <= c->size * c->size) || (full && !(distance2 < s->distance2[s->count - 1])) ||
        vec_dot(at->normal, s->normal) < s->cosine || !is_same(from, c->cell[i]))
        return;
    size_t k = full ? s->count - 1 : s->count++;
    for (; k > 0 && distance2 < s->distance2[k - 1]; k--) {
        s->found[k] = s->found[k - 1];
        s->distance2[k] = s->distance2[k - 1];
    }
    s->found[k] = i;
    s->distance2[k] = distance2;
}

static void search_cell(search *s, transfer_cell at) {
    const transfer_cells *c = s->cells;
    const uint32_t hash = hash_of(c, at);
    for (uint32_t i = c->begin[hash]; i < c->begin[hash + 1]; i++)
        consider(s, at, i);
}

/* Returns the distance beyond which no surfel counts any more, squared. */
static float reach2(const search *s) {
    return s->count == s->capacity ? s->distance2[s->count - 1] : s->cells->size * s->cells->size;
}

/* A cell and those around it, the nearest first: once enough is found, those further away are
 * passed over. */
static const int8_t cells_around[27][3] = {
    { 0, 0, 0 },  { -1, 0, 0 },   { 1, 0, 0 },   { 0, -1, 0 },  { 0, 1, 0 },  { 0, 0, -1 },
    { 0, 0, 1 },  { -1, -1, 0 },  { 1, -1, 0 },  { -1, 1, 0 },  { 1, 1, 0 },  { -1, 0, -1 },
    { 1, 0, -1 }, { -1, 0, 1 },   { 1, 0, 1 },   { 0, -1, -1 }, { 0, 1, -1 }, { 0, -1, 1 },
    { 0, 1, 1 },  { -1, -1, -1 }, { 1, -1, -1 }, { -1, 1, -1 }, { 1, 1, -1 }, { -1, -1, 1 },
    { 1, -1, 1 }, { -1, 1, 1 },   { 1, 1, 1 },
};

/* Finds the squared distances of a coordinate from its cell, and from those below and above. */
static void find_distances(float x, float size, int32_t at, float distance2[3]) {
    const float below = x - (float)at * size, above = (float)(at + 1) * size - x;
    distance2[0] = below * below;
    distance2[1] = 0;
    distance2[2] = above * above;
}

static void search_around(search *s) {
    const transfer_cells *c = s->cells;
    const transfer_cell middle = cell_of(c, s->point);
    float x2[3], y2[3], z2[3];
    find_distances(s->point.x, c->size, middle.x, x2);
    find_distances(s->point.y, c->size, middle.y, y2);
    find_distances(s->point.z, c->size, middle.z, z2);
    for (int i = 0; i < 27; i++) {
        const int8_t *to = cells_around[i];
        if (x2[to[0] + 1] + y2[to[1] + 1] + z2[to[2] + 1] <= reach2(s))
            search_cell(s,
                        (transfer_cell) { middle.x + to[0], middle.y + to[1], middle.z + to[2] });
    }
}

size_t transfer_cells_find(const transfer_cells *c, lmp_vec3 point, lmp_vec3 normal, float cosine,
                           size_t capacity, uint32_t *found) {
    search s = { .cells = c,
                 .point = point,
                 .normal = normal,
                 .cosine = cosine,
                 .capacity = capacity < FOUND_MAX ? capacity : FOUND_MAX,
                 .found = found };
    search_around(&s);
    return s.count;
}
