/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/transfer_cells.h"

#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

enum { FOUND_MAX = 32 };

/* Off the plane of the surface a distance counts so many times as much, squared: a point of a rug
 * is nearer to the rug's surfels than to those of the floor under it. */
#define BESIDE 400.0f

static transfer_cell cell_of(const transfer_cells *c, lmp_vec3 point) {
    return (transfer_cell) { .x = (int32_t)floorf(point.x / c->size),
                             .y = (int32_t)floorf(point.y / c->size),
                             .z = (int32_t)floorf(point.z / c->size) };
}

static bool is_same(const transfer_cell *a, const transfer_cell *b) {
    return a->x == b->x && a->y == b->y && a->z == b->z;
}

/* Returns the place of a cell in the table, or the free one where it would be. */
static transfer_cell *place_of(const transfer_cells *c, const transfer_cell *at) {
    uint32_t i = transfer_hash(at->x, at->y, at->z) & c->mask;
    while (c->table[i].end > 0 && !is_same(&c->table[i], at))
        i = (i + 1) & c->mask;
    return &c->table[i];
}

/* --- order ------------------------------------------------------------------------------------ */

/* A surfel on the Morton curve through the cells. */
typedef struct ordered_surfel {
    uint64_t key;
    uint32_t index;
} ordered_surfel;

/* Returns the lowest 21 bits of a coordinate, two zeros before each. */
static uint64_t spread_bits(int32_t x) {
    uint64_t spread = 0;
    for (int bit = 0; bit < 21; bit++)
        spread |= ((uint64_t)(uint32_t)x >> bit & 1) << 3 * bit;
    return spread;
}

static int compare_keys(const void *a, const void *b) {
    const ordered_surfel *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* Sorts surfels so that those near each other in space are near in memory. */
static bool sort_surfels(transfer_surfels *s, const transfer_cells *c) {
    ordered_surfel *order = malloc((s->count + 1) * sizeof *order);
    lmp_transfer_surfel *sorted = malloc((s->count + 1) * sizeof *sorted);
    const bool ok = order && sorted;
    for (size_t i = 0; i < s->count && ok; i++) {
        const transfer_cell at = cell_of(c, s->at[i].position);
        order[i] =
            (ordered_surfel) { spread_bits(at.x) | spread_bits(at.y) << 1 | spread_bits(at.z) << 2,
                               (uint32_t)i };
    }
    if (ok) {
        qsort(order, s->count, sizeof *order, compare_keys);
        for (size_t i = 0; i < s->count; i++)
            sorted[i] = s->at[order[i].index];
        memcpy(s->at, sorted, s->count * sizeof *sorted);
    }
    free(order);
    free(sorted);
    return ok;
}

bool transfer_cells_create(transfer_surfels *s, transfer_cells *c) {
    *c = (transfer_cells) { .surfels = s, .size = TRANSFER_NEAR * s->spacing, .mask = 1 };
    while (c->mask < 2 * s->count)
        c->mask = 2 * c->mask + 1;
    c->table = calloc((size_t)c->mask + 1, sizeof *c->table);
    if (!c->table || !sort_surfels(s, c))
        return false;
    for (uint32_t i = 0; i < s->count; i++) {
        const transfer_cell at = cell_of(c, s->at[i].position);
        transfer_cell *place = place_of(c, &at);
        if (place->end == 0)
            *place = (transfer_cell) { at.x, at.y, at.z, i, i };
        place->end = i + 1;
    }
    return true;
}

void transfer_cells_free(transfer_cells *c) {
    free(c->table);
    *c = (transfer_cells) { .table = NULL };
}

/* --- search ----------------------------------------------------------------------------------- */

/* The nearest surfels so far. */
typedef struct search {
    const transfer_cells *cells;
    lmp_vec3 point, normal;
    float cosine;
    size_t capacity, count;
    uint32_t *found;
    float distance2[FOUND_MAX];
} search;

static void consider(search *s, uint32_t i) {
    const transfer_cells *c = s->cells;
    const lmp_transfer_surfel *at = &c->surfels->at[i];
    const lmp_vec3 away = vec_sub(at->position, s->point);
    const float height = vec_dot(away, s->normal), straight2 = vec_dot(away, away);
    const float distance2 = straight2 + BESIDE * height * height;
    const bool full = s->count == s->capacity;
    if (!(straight2 <= c->size * c->size) || (full && !(distance2 < s->distance2[s->count - 1])) ||
        vec_dot(at->normal, s->normal) < s->cosine)
        return;
    size_t k = full ? s->count - 1 : s->count++;
    for (; k > 0 && distance2 < s->distance2[k - 1]; k--) {
        s->found[k] = s->found[k - 1];
        s->distance2[k] = s->distance2[k - 1];
    }
    s->found[k] = i;
    s->distance2[k] = distance2;
}

static void search_cell(search *s, const transfer_cell *at) {
    const transfer_cell *cell = place_of(s->cells, at);
    for (uint32_t i = cell->begin; i < cell->end; i++)
        consider(s, i);
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
            search_cell(s, &(transfer_cell) { .x = middle.x + to[0],
                                              .y = middle.y + to[1],
                                              .z = middle.z + to[2] });
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
