/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_cells.h"

#include "app/scene/vector.h"

#include <stdlib.h>

enum { FOUND_MAX = 32 };

/* Off the plane of the surface a distance counts so many times as much, squared: a point of a rug
 * is nearer to the rug's surfels than to those of the floor under it. */
#define BESIDE 400.0f

typedef struct cell {
    int32_t x, y, z;
} cell;

static cell cell_of(const transfer_cells *c, lmp_vec3 point) {
    return (cell) { (int32_t)floorf(point.x / c->size), (int32_t)floorf(point.y / c->size),
                    (int32_t)floorf(point.z / c->size) };
}

static uint32_t hash_of(const transfer_cells *c, cell at) {
    const uint32_t hash =
        (uint32_t)at.x * 0x9e3779b1u ^ (uint32_t)at.y * 0x85ebca6bu ^ (uint32_t)at.z * 0xc2b2ae35u;
    return (hash ^ hash >> 15) & c->mask;
}

static bool is_same(cell a, cell b) {
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
    return true;
}

bool transfer_cells_create(transfer_surfels *s, transfer_cells *c) {
    *c = (transfer_cells) { .surfels = s, .size = TRANSFER_NEAR * s->spacing, .mask = 1 };
    while (c->mask < s->count)
        c->mask = 2 * c->mask + 1;
    c->begin = calloc((size_t)c->mask + 2, sizeof *c->begin);
    return c->begin && sort_surfels(s, c);
}

void transfer_cells_free(transfer_cells *c) {
    free(c->begin);
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
static void consider(search *s, cell from, uint32_t i) {
    const transfer_cells *c = s->cells;
    const lmp_transfer_surfel *at = &c->surfels->at[i];
    const lmp_vec3 away = vec_sub(at->position, s->point);
    const float height = vec_dot(away, s->normal), straight2 = vec_dot(away, away);
    const float distance2 = straight2 + BESIDE * height * height;
    const bool full = s->count == s->capacity;
    if (!(straight2 <= c->size * c->size) || (full && !(distance2 < s->distance2[s->count - 1])) ||
        vec_dot(at->normal, s->normal) < s->cosine || !is_same(from, cell_of(c, at->position)))
        return;
    size_t k = full ? s->count - 1 : s->count++;
    for (; k > 0 && distance2 < s->distance2[k - 1]; k--) {
        s->found[k] = s->found[k - 1];
        s->distance2[k] = s->distance2[k - 1];
    }
    s->found[k] = i;
    s->distance2[k] = distance2;
}

static void search_cell(search *s, cell at) {
    const transfer_cells *c = s->cells;
    const uint32_t hash = hash_of(c, at);
    for (uint32_t i = c->begin[hash]; i < c->begin[hash + 1]; i++)
        consider(s, at, i);
}

/* Searches the cells that hold all within half a cell of the point. */
static void search_eight(search *s) {
    const float half = s->cells->size / 2;
    const cell low = cell_of(s->cells, vec_sub(s->point, vec(half, half, half)));
    for (int i = 0; i < 8; i++)
        search_cell(s, (cell) { low.x + (i & 1), low.y + (i >> 1 & 1), low.z + (i >> 2) });
}

/* Searches all cells that a surfel found can be in. */
static void search_all(search *s) {
    const cell middle = cell_of(s->cells, s->point);
    s->count = 0;
    for (int i = 0; i < 27; i++)
        search_cell(
            s, (cell) { middle.x + i % 3 - 1, middle.y + i / 3 % 3 - 1, middle.z + i / 9 - 1 });
}

size_t transfer_cells_find(const transfer_cells *c, lmp_vec3 point, lmp_vec3 normal, float cosine,
                           size_t capacity, uint32_t *found) {
    search s = { .cells = c,
                 .point = point,
                 .normal = normal,
                 .cosine = cosine,
                 .capacity = capacity < FOUND_MAX ? capacity : FOUND_MAX,
                 .found = found };
    const float half = c->size / 2;
    search_eight(&s);
    if (s.count < s.capacity || !(s.distance2[s.count - 1] <= half * half))
        search_all(&s);
    return s.count;
}
