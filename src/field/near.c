/* SPDX-License-Identifier: MIT */
/* near.c - which lights are near which cells: a list per block of cells, in a pool of entries that
 * was allocated with the field. A light whose lists do not fit is near everywhere. */
#include "src/field/near.h"

#include <math.h>
#include <string.h>

/* --- lists ------------------------------------------------------------------------------------ */

/* A ball around a light, in coordinates from the grid's origin, the edges of a block, and the range
 * of blocks that its bounding box covers. */
typedef struct near_ball {
    float center[3], radius, edge[3];
    uint32_t first[3], end[3];
} near_ball;

static float coordinate(lmp_vec3 v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

static uint32_t held(float block, uint32_t count) {
    return block > 0 ? block < (float)count ? (uint32_t)block : count : 0;
}

static float block_edge(const lmp_field *field, int axis) {
    return FIELD_BLOCK * coordinate(field->info.desc.cell, axis);
}

static near_ball ball_of(const lmp_field *field, const field_sphere *sphere) {
    near_ball ball = { .radius = lmpi_field_around(sphere, field->info.reach) };
    for (int a = 0; a < 3; a++) {
        const float edge = block_edge(field, a);
        ball.edge[a] = edge;
        ball.center[a] = coordinate(sphere->center, a) - coordinate(field->info.desc.origin, a);
        ball.first[a] = held(floorf((ball.center[a] - ball.radius) / edge), field->blocks[a]);
        ball.end[a] = held(floorf((ball.center[a] + ball.radius) / edge) + 1, field->blocks[a]);
    }
    return ball;
}

/* Returns the squared distance of a block from the center along an axis. */
static float gap2(const near_ball *ball, int axis, uint32_t block) {
    const float low = ball->edge[axis] * (float)block;
    const float gap = lmpi_field_gap(low, ball->center[axis], low + ball->edge[axis]);
    return gap * gap;
}

/* Whether the ball reaches a block whose squared distances along the last two axes are others2. */
static bool reaches_along(const near_ball *ball, uint32_t block, const float others2[2]) {
    return gap2(ball, 0, block) + others2[0] + others2[1] <= ball->radius * ball->radius;
}

static bool reaches(const near_ball *ball, const uint32_t block[3]) {
    const float others2[2] = { gap2(ball, 1, block[1]), gap2(ball, 2, block[2]) };
    for (int a = 0; a < 3; a++)
        if (block[a] < ball->first[a] || block[a] >= ball->end[a])
            return false;
    return reaches_along(ball, block[0], others2);
}

typedef void list_action(lmp_field *field, uint32_t light, size_t list);

/* Applies an action to the list of every block that a light's ball reaches and `other`, if it is
 * not NULL, does not; returns how many blocks those are. */
static size_t each_list(lmp_field *field, uint32_t light, const near_ball *ball,
                        const near_ball *other, list_action *action) {
    uint32_t at[3];
    size_t count = 0;
    for (at[2] = ball->first[2]; at[2] < ball->end[2]; at[2]++)
        for (at[1] = ball->first[1]; at[1] < ball->end[1]; at[1]++) {
            const float others2[2] = { gap2(ball, 1, at[1]), gap2(ball, 2, at[2]) };
            const size_t row = (at[2] * field->blocks[1] + at[1]) * field->blocks[0];
            for (at[0] = ball->first[0]; at[0] < ball->end[0]; at[0]++)
                if (reaches_along(ball, at[0], others2) && !(other && reaches(other, at))) {
                    action(field, light, row + at[0]);
                    count++;
                }
        }
    return count;
}

static void none(lmp_field *field, uint32_t light, size_t list) {
    (void)field;
    (void)light;
    (void)list;
}

static void put(lmp_field *field, uint32_t light, size_t list) {
    uint32_t at = field->lists[list];
    if (at == FIELD_NONE || field->entries[at].count == FIELD_ENTRY) {
        const uint32_t next = at;
        at = field->free;
        if (at == FIELD_NONE)
            at = field->untouched++;
        else
            field->free = field->entries[at].next;
        field->free_count--;
        field->entries[at].next = next;
        field->entries[at].count = 0;
        field->lists[list] = at;
    }
    field_entry *entry = &field->entries[at];
    entry->lights[entry->count++] = light;
}

/* Finds a light in a list. */
static uint32_t *position(const lmp_field *field, uint32_t light, size_t list) {
    for (uint32_t at = field->lists[list];; at = field->entries[at].next) {
        field_entry *entry = &field->entries[at];
        for (uint32_t i = 0; i < entry->count; i++)
            if (entry->lights[i] == light)
                return &entry->lights[i];
    }
}

/* Removes a light from a list: the last light of the first entry takes its position. */
static void take(lmp_field *field, uint32_t light, size_t list) {
    const uint32_t first = field->lists[list];
    field_entry *entry = &field->entries[first];
    uint32_t *const gone = position(field, light, list);
    *gone = entry->lights[--entry->count];
    if (entry->count > 0)
        return;
    field->lists[list] = entry->next;
    entry->next = field->free;
    field->free = first;
    field->free_count++;
}

/* Whether the lists of a ball's blocks have room, beside the entries reserved for lights that may
 * become near everywhere. Blocks are counted only where the ball's bounding box has too many. */
static bool is_room(lmp_field *field, uint32_t light, const near_ball *ball) {
    const size_t kept = field->info.desc.light_max / FIELD_ENTRY + 1;
    size_t box = 1;
    for (int a = 0; a < 3; a++)
        box *= ball->end[a] - ball->first[a];
    return box + kept <= field->free_count ||
           each_list(field, light, ball, NULL, none) + kept <= field->free_count;
}

static void list_light(lmp_field *field, uint32_t light) {
    const near_ball ball = ball_of(field, &field->spheres[light]);
    field->everywhere[light] =
        !(lmpi_light_fades(&field->lights[light]) && is_room(field, light, &ball));
    if (field->everywhere[light])
        put(field, light, field->block_count);
    else
        each_list(field, light, &ball, NULL, put);
}

/* Removes a light from the lists that it joined when it was this sphere. */
static void unlist_light(lmp_field *field, uint32_t light, const field_sphere *sphere) {
    const near_ball ball = ball_of(field, sphere);
    if (field->everywhere[light])
        take(field, light, field->block_count);
    else
        each_list(field, light, &ball, NULL, take);
}

/* Lists a light that moved. It stays in most of its lists, which are long: those are not touched.
 */
static void relist_light(lmp_field *field, uint32_t light, const field_sphere *was) {
    const near_ball before = ball_of(field, was), after = ball_of(field, &field->spheres[light]);
    if (field->everywhere[light] || !lmpi_light_fades(&field->lights[light]) ||
        !is_room(field, light, &after)) {
        unlist_light(field, light, was);
        list_light(field, light);
        return;
    }
    each_list(field, light, &before, &after, take);
    each_list(field, light, &after, &before, put);
}

/* Empties all lists. Entries are not chained, because most are never used, and they are far more
 * than caches hold. */
static void unlist_all(lmp_field *field) {
    memset(field->lists, 0xff, (field->block_count + 1) * sizeof *field->lists);
    field->free = FIELD_NONE;
    field->untouched = 0;
    field->free_count = (uint32_t)field->entry_count;
}

void lmpi_field_list(lmp_field *field, uint32_t light) {
    for (lmp_field *level = field; level; level = level->coarse)
        list_light(level, light);
}

void lmpi_field_unlist(lmp_field *field, uint32_t light) {
    for (lmp_field *level = field; level; level = level->coarse)
        unlist_light(level, light, &field->spheres[light]);
}

void lmpi_field_relist(lmp_field *field, uint32_t light, const field_sphere *was) {
    for (lmp_field *level = field; level; level = level->coarse)
        relist_light(level, light, was);
}

void lmpi_field_unlist_all(lmp_field *field) {
    for (lmp_field *level = field; level; level = level->coarse)
        unlist_all(level);
}

/* --- sets ------------------------------------------------------------------------------------- */

void lmpi_field_set_clear(const lmp_field *field, field_set *set) {
    set->words = (field->info.light_count + 63) / 64;
    memset(set->bits, 0, set->words * sizeof *set->bits);
}

static void add_list(const lmp_field *field, size_t list, field_set *set) {
    for (uint32_t at = field->lists[list]; at != FIELD_NONE; at = field->entries[at].next) {
        const field_entry *entry = &field->entries[at];
        for (uint32_t i = 0; i < entry->count; i++)
            set->bits[entry->lights[i] / 64] |= (uint64_t)1 << entry->lights[i] % 64;
    }
}

void lmpi_field_set_add(const lmp_field *field, uint32_t block, field_set *set) {
    add_list(field, block, set);
    add_list(field, field->block_count, set);
}

void lmpi_field_set_add_all(const lmp_field *field, field_set *set) {
    for (size_t i = 0; i < field->info.light_count; i++)
        set->bits[i / 64] |= (uint64_t)1 << i % 64;
}

size_t lmpi_field_set_find(const lmp_field *field, const field_set *set, const field_box *box,
                           size_t capacity, uint32_t *next, uint32_t *lights) {
    size_t count = 0;
    for (size_t word = *next / 64; word < set->words; word++)
        for (uint64_t bits = set->bits[word]; bits; bits &= bits - 1) {
            const uint32_t light = (uint32_t)(64 * word) + (uint32_t)__builtin_ctzll(bits);
            if (light < *next)
                continue;
            if (count == capacity) {
                *next = light;
                return count;
            }
            lights[count] = light;
            count += !box || lmpi_field_is_near(field, light, box);
        }
    *next = FIELD_NONE;
    return count;
}
