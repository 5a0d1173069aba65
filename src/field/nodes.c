/* SPDX-License-Identifier: MIT */
/* nodes.c - computes the nodes of a field by bricks, from all lights, or from a coarser field and
 * the lights near the nodes. */
#include "src/field/nodes.h"
#include "src/kernels/dispatch.h"

#include <math.h>
#include <string.h>

static size_t brick_floats(const lmp_field *field) {
    return FIELD_BRICK * 4 * field->stride;
}

/* Returns a task's own scratch. */
static float *scratch_of(const lmp_field *field, size_t task) {
    return (float *)(void *)((char *)field->scratch + task * lmpi_field_scratch(field));
}

/* --- states ----------------------------------------------------------------------------------- */

void lmpi_field_set_states(lmp_field *field, unsigned char state) {
    for (lmp_field *level = field; level; level = level->coarse)
        for (size_t i = 0; i < level->brick_count; i++)
            atomic_store_explicit(&level->states[i], state, memory_order_relaxed);
}

static unsigned char state_of(const lmp_field *field, size_t brick) {
    return atomic_load_explicit(&field->states[brick], memory_order_relaxed);
}

static void want(lmp_field *field, size_t brick) {
    if (state_of(field, brick) == FIELD_STALE)
        atomic_store_explicit(&field->states[brick], FIELD_WANTED, memory_order_relaxed);
}

/* Marks the bricks of a cell's eight corners as wanted. */
static void want_corners(lmp_field *field, const uint32_t cell[3]) {
    for (uint32_t k = 0; k < 8; k++)
        want(field, lmpi_field_node(field, cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4) /
                        FIELD_BRICK);
}

void lmp_field_want_n(lmp_field *field, lmp_vec3_array points, size_t count) {
    uint32_t last[3] = { UINT32_MAX, 0, 0 };
    assert(lmpi_are_finite(points, count));
    for (size_t i = 0; i < count; i++) {
        field_place place;
        if (!lmpi_field_find(field, lmpi_vec3_element(&points, i), &place) ||
            lmpi_field_same_cell(place.cell, last))
            continue;
        want_corners(field, place.cell);
        memcpy(last, place.cell, sizeof last);
    }
}

/* --- bricks ----------------------------------------------------------------------------------- */

/* Finds the indices of a brick's first node along the axes. */
static void find_brick(const lmp_field *field, size_t brick, uint32_t first[3]) {
    first[0] = 4 * (uint32_t)(brick % field->bricks[0]);
    first[1] = 2 * (uint32_t)(brick / field->bricks[0] % field->bricks[1]);
    first[2] = 2 * (uint32_t)(brick / field->bricks[0] / field->bricks[1]);
}

/* Finds the indices of node i of a brick. */
static void find_node(const uint32_t first[3], uint32_t i, uint32_t node[3]) {
    node[0] = first[0] + i % 4;
    node[1] = first[1] + i / 4 % 2;
    node[2] = first[2] + i / 8;
}

typedef struct brick_points {
    float at[3][FIELD_BRICK] __attribute__((aligned(64)));
} brick_points;

static void set_points(const lmp_field *field, const uint32_t first[3], brick_points *points) {
    const lmp_field_desc *desc = &field->info.desc;
    for (uint32_t i = 0; i < FIELD_BRICK; i++) {
        uint32_t node[3];
        find_node(first, i, node);
        points->at[0][i] = desc->origin.x + desc->cell.x * (float)node[0];
        points->at[1][i] = desc->origin.y + desc->cell.y * (float)node[1];
        points->at[2][i] = desc->origin.z + desc->cell.z * (float)node[2];
    }
}

/* Marks the coarser nodes as wanted that a brick is interpolated from: they lie in two cells. */
static void want_coarse(const lmp_field *field, size_t brick) {
    uint32_t node[3];
    find_brick(field, brick, node);
    for (uint32_t i = 0; i < 2; i++) {
        const uint32_t cell[3] = { node[0] / 2 + i, node[1] / 2, node[2] / 2 };
        want_corners(field->coarse, cell);
    }
}

/* --- lights ----------------------------------------------------------------------------------- */

/* Adds lights to a brick's nodes, as the field holds them: without what the coarser field holds. */
static void add_lights(const lmp_field *field, const brick_points *points,
                       const field_sphere *spheres, size_t count, float *scratch, float *nodes) {
    const size_t values = field->values;
    const lmp_vec3 *center = &spheres->center;
    const lmp_rgb *radiance = &spheres->radiance;
    const lmpi_kernel_lights lights = {
        .center = { &center->x, &center->y, &center->z, sizeof *spheres },
        .radius = { &spheres->radius, sizeof *spheres },
        .radiance = { &radiance->r, &radiance->g, &radiance->b, sizeof *spheres },
        .count = count,
    };
    const lmpi_kernel_vec3 at = { points->at[0], points->at[1], points->at[2] };
    const lmpi_kernel_fade fade = { 1 / field->info.reach,
                                    field->coarse ? 1 / field->coarse->info.reach : 0 };
    const lmpi_kernel_out out = { scratch, 4 * values, 0 };
    const lmpi_kernel_out slopes = { scratch + values, 4 * values, 0 };
    if (count == 0)
        return;
    lmpi_kernels_get()->light.fading_gradient(NULL, field->info.desc.bands, &lights, &at,
                                              LMP_COS_MIN, fade, FIELD_BRICK, &out, &slopes);
    for (size_t row = 0; row < 4 * FIELD_BRICK; row++)
        for (size_t v = 0; v < values; v++)
            nodes[row * field->stride + v] += scratch[row * values + v];
}

static field_box box_of(const brick_points *points) {
    const float(*at)[FIELD_BRICK] = points->at;
    const int last = FIELD_BRICK - 1;
    return (field_box) { { at[0][0], at[1][0], at[2][0] },
                         { at[0][last], at[1][last], at[2][last] } };
}

/* Whether the coarser field may lack part of the sphere at a node of the brick. */
static bool is_near(const lmp_field *field, const field_box *box, const field_sphere *sphere) {
    const float reach = lmpi_field_around(sphere, field->coarse->info.reach) * 1.0001f;
    return lmpi_field_distance2(box, sphere->center) < reach * reach;
}

/* The lights near a brick, which are added a pass at a time. */
typedef struct brick_lights {
    const lmp_field *field;
    uint32_t first[3]; /* the brick's first node */
    brick_points points;
    field_box box;
    field_sphere *near;
    size_t count;
    float *scratch, *nodes;
} brick_lights;

static void flush(brick_lights *lights) {
    add_lights(lights->field, &lights->points, lights->near, lights->count, lights->scratch,
               lights->nodes);
    lights->count = 0;
}

/* Begins a brick without any light; sums go to `nodes`. */
static void begin(const lmp_field *field, size_t brick, float *scratch, float *nodes,
                  brick_lights *lights) {
    lights->field = field;
    lights->count = 0;
    lights->scratch = scratch;
    lights->near = (field_sphere *)(void *)(scratch + brick_floats(field));
    lights->nodes = nodes;
    find_brick(field, brick, lights->first);
    set_points(field, lights->first, &lights->points);
    lights->box = box_of(&lights->points);
}

/* Adds all lights, near or far, where there is no coarser field. */
static void take_all(const brick_lights *lights, const field_sphere *spheres, size_t count) {
    add_lights(lights->field, &lights->points, spheres, count, lights->scratch, lights->nodes);
}

static void take(brick_lights *lights, const field_sphere *sphere) {
    if (!is_near(lights->field, &lights->box, sphere))
        return;
    lights->near[lights->count++] = *sphere;
    if (lights->count == FIELD_PASS)
        flush(lights);
}

static void take_list(brick_lights *lights, uint32_t list) {
    const lmp_field *field = lights->field;
    const lmp_field *coarse = field->coarse;
    for (uint32_t at = coarse->lists[list]; at != FIELD_NONE; at = coarse->entries[at].next) {
        const field_entry *entry = &coarse->entries[at];
        for (uint32_t i = 0; i < entry->count; i++)
            take(lights, &field->spheres[entry->lights[i]]);
    }
}

/* Describes what a brick's nodes are interpolated from, the coarser field's nodes or their changes,
 * and the nodes that are written next, to be fetched. */
static lmpi_kernel_brick brick_of(const lmp_field *field, const uint32_t first[3],
                                  const float *from, const float *next) {
    const lmp_field *coarse = field->coarse;
    lmpi_kernel_brick brick = { .stride = field->stride,
                                .cell = coarse->info.desc.cell,
                                .next = next };
    for (uint32_t i = 0; i < 12; i++)
        brick.from[i] = from + 4 * field->stride *
                                   lmpi_field_node(coarse, first[0] / 2 + i % 3,
                                                   first[1] / 2 + i / 3 % 2, first[2] / 2 + i / 6);
    return brick;
}

/* Computes what all lights give a brick's nodes. */
static void compute(const lmp_field *field, size_t brick, float *scratch) {
    float *nodes = field->nodes + brick * brick_floats(field);
    brick_lights lights;
    begin(field, brick, scratch, nodes, &lights);
    if (!field->coarse) {
        memset(nodes, 0, brick_floats(field) * sizeof *nodes);
        take_all(&lights, field->spheres, field->info.light_count);
        return;
    }
    const uint32_t cell[3] = { lights.first[0] / 2, lights.first[1] / 2, lights.first[2] / 2 };
    const lmpi_kernel_brick from = brick_of(field, lights.first, field->coarse->nodes, nodes);
    lmpi_kernels_get()->field.refine(&from, nodes);
    take_list(&lights, lmpi_field_block(field->coarse, cell));
    take_list(&lights, (uint32_t)field->coarse->block_count);
    flush(&lights);
}

/* Computes every task_count-th brick, with the task's own scratch. */
static lmp_result compute_task(size_t index, void *data) {
    lmp_field *field = data;
    float *scratch = scratch_of(field, index);
    for (size_t brick = index; brick < field->brick_count; brick += field->task_count)
        if (state_of(field, brick) == FIELD_WANTED) {
            compute(field, brick, scratch);
            atomic_store_explicit(&field->states[brick], FIELD_READY, memory_order_relaxed);
        }
    return LMP_OK;
}

/* Computes the wanted bricks, those of coarser fields first: these have an eighth of the nodes, and
 * take that part of `done`. */
static lmp_result compute_wanted(const lmp_host *host, lmp_field *field, double done) {
    const double before = field->coarse ? done / 8 : 0;
    if (field->coarse) {
        for (size_t brick = 0; brick < field->brick_count; brick++)
            if (state_of(field, brick) == FIELD_WANTED)
                want_coarse(field, brick);
        const lmp_result result = compute_wanted(host, field->coarse, before);
        if (result != LMP_OK)
            return result;
    }
    return lmpi_host_run(host, before, done, field->task_count, compute_task, field);
}

lmp_result lmp_field_compute(const lmp_host *host, lmp_field *field) {
    const lmp_host resolved = lmpi_host_resolve(host);
    return compute_wanted(&resolved, field, 1);
}

void lmpi_field_refresh(lmp_field *field, uint64_t turn) {
    const size_t brick = (size_t)(turn % field->brick_count);
    if (field->coarse)
        lmpi_field_refresh(field->coarse, turn);
    if (state_of(field, brick) == FIELD_READY)
        compute(field, brick, field->scratch);
}

/* --- changes ---------------------------------------------------------------------------------- */

typedef struct field_change {
    lmp_field *field;
    const field_sphere *spheres;
    size_t count;
} field_change;

/* Computes what a change gives a brick: added to its nodes, or in place of the last change. */
static void take_change(const field_change *change, size_t brick, bool adds, float *scratch,
                        float *nodes) {
    const lmp_field *field = change->field;
    const lmpi_kernels *kernels = lmpi_kernels_get();
    brick_lights lights;
    begin(field, brick, scratch, nodes, &lights);
    if (!field->coarse) {
        if (!adds)
            memset(nodes, 0, brick_floats(field) * sizeof *nodes);
        take_all(&lights, change->spheres, change->count);
        return;
    }
    const float *next = brick + 1 < field->brick_count ? nodes + brick_floats(field) : nodes;
    const lmpi_kernel_brick from = brick_of(field, lights.first, field->coarse->changes, next);
    (adds ? kernels->field.refine_add : kernels->field.refine)(&from, nodes);
    for (size_t i = 0; i < change->count; i++)
        take(&lights, &change->spheres[i]);
    flush(&lights);
}

/* Applies a change to a brick; a coarser field also keeps the change of its nodes. */
static void compute_change(const field_change *change, size_t brick, float *scratch) {
    const lmp_field *field = change->field;
    const size_t size = brick_floats(field);
    float *nodes = field->nodes + brick * size;
    if (!field->changes) {
        take_change(change, brick, true, scratch, nodes);
        return;
    }
    float *changes = field->changes + brick * size;
    take_change(change, brick, false, scratch, changes);
    for (size_t i = 0; i < size; i++)
        nodes[i] += changes[i];
}

static void change_task(size_t index, void *data) {
    const field_change *change = data;
    const lmp_field *field = change->field;
    float *scratch = scratch_of(field, index);
    const size_t end = (index + 1) * field->brick_count / field->task_count;
    for (size_t brick = index * field->brick_count / field->task_count; brick < end; brick++)
        if (state_of(field, brick) == FIELD_READY)
            compute_change(change, brick, scratch);
}

void lmpi_field_add_spheres(const lmp_host *host, lmp_field *field, const field_sphere *spheres,
                            size_t count) {
    const lmp_host resolved = lmpi_host_resolve(host);
    field_change change = { field, spheres, count };
    if (field->coarse)
        lmpi_field_add_spheres(host, field->coarse, spheres, count);
    resolved.parallel(field->task_count, change_task, &change, resolved.user);
}
