/* SPDX-License-Identifier: MIT */
/* update.c - what becomes of a field's nodes and lists when its lights change. */
#include "src/field/field.h"
#include "src/light/cap.h"

#include <math.h>
#include <string.h>

/* Lights that one pass over the nodes adds, and takes away, at most. */
enum { PASS = 32 };

static const float pi = 3.14159265f;

/* --- lights ----------------------------------------------------------------------------------- */

/* A point is a sphere this small (src/shade/chunk.h). */
static field_sphere sphere_of(const lmp_light *light) {
    const float area = pi * LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    const lmp_rgb i = light->intensity;
    switch (light->kind) {
    case LMP_LIGHT_SPHERE:
        return (field_sphere) { light->position, light->radius, light->radiance };
    case LMP_LIGHT_POINT:
        return (field_sphere) { light->position,
                                LMP_POINT_DISTANCE_MIN,
                                { i.r / area, i.g / area, i.b / area } };
    default:
        return (field_sphere) { .radius = 0 };
    }
}

void lmp_field_set_light(lmp_field *field, uint32_t at, const lmp_light *light) {
    field->lights[at] = *light;
    field->spheres[at] = sphere_of(light);
    lmp_field_list(field, at);
}

static lmp_kernel_lights kernel_lights(const field_sphere *spheres, size_t count) {
    const lmp_vec3 *center = &spheres->center;
    const lmp_rgb *radiance = &spheres->radiance;
    return (lmp_kernel_lights) {
        .center = { &center->x, &center->y, &center->z, sizeof *spheres },
        .radius = { &spheres->radius, sizeof *spheres },
        .radiance = { &radiance->r, &radiance->g, &radiance->b, sizeof *spheres },
        .count = count,
    };
}

/* --- nodes ------------------------------------------------------------------------------------ */

static size_t brick_size(const lmp_field *field) {
    return FIELD_BRICK * 4 * field->values;
}

/* What the lights give a brick's nodes. */
static void compute(const lmp_field *field, size_t brick, const lmp_kernel_lights *lights,
                    float *nodes) {
    const lmp_field_desc *desc = &field->info.desc;
    float at[3][FIELD_BRICK] __attribute__((aligned(64)));
    const size_t x = brick % field->bricks[0], y = brick / field->bricks[0] % field->bricks[1];
    const size_t z = brick / field->bricks[0] / field->bricks[1];
    for (size_t i = 0; i < FIELD_BRICK; i++) {
        at[0][i] = desc->origin.x + desc->cell.x * (float)(4 * x + i % 4);
        at[1][i] = desc->origin.y + desc->cell.y * (float)(2 * y + i / 4 % 2);
        at[2][i] = desc->origin.z + desc->cell.z * (float)(2 * z + i / 8);
    }
    const lmp_kernel_vec3 points = { at[0], at[1], at[2] };
    const lmp_kernel_out out = { nodes, 4 * field->values, 0 };
    const lmp_kernel_out slopes = { nodes + field->values, 4 * field->values, 0 };
    lmp_kernels_get()->fading_gradient(NULL, desc->bands, lights, &points, LMP_COS_MIN,
                                       1 / field->info.reach, FIELD_BRICK, &out, &slopes);
}

static lmp_result compute_task(size_t brick, void *data) {
    const lmp_field *field = data;
    const lmp_kernel_lights lights = kernel_lights(field->spheres, field->info.light_count);
    compute(field, brick, &lights, field->nodes + brick * brick_size(field));
    return LMP_OK;
}

void lmp_field_set_states(lmp_field *field, unsigned char state) {
    for (size_t i = 0; i < field->brick_count; i++)
        atomic_store_explicit(&field->states[i], state, memory_order_relaxed);
}

static unsigned char state_of(const lmp_field *field, size_t brick) {
    return atomic_load_explicit(&field->states[brick], memory_order_relaxed);
}

static void want(lmp_field *field, size_t brick) {
    if (state_of(field, brick) == FIELD_STALE)
        atomic_store_explicit(&field->states[brick], FIELD_WANTED, memory_order_relaxed);
}

/* Of a cell's eight corners. */
static void want_corners(lmp_field *field, const uint32_t cell[3]) {
    for (uint32_t k = 0; k < 8; k++)
        want(field, lmp_field_node(field, cell[0] + k % 2, cell[1] + k / 2 % 2, cell[2] + k / 4) /
                        FIELD_BRICK);
}

void lmp_field_want(lmp_field *field, lmp_vec3_array points, size_t count) {
    uint32_t last[3] = { UINT32_MAX, 0, 0 };
    assert(lmp_are_finite(points, count));
    for (size_t i = 0; i < count; i++) {
        field_place place;
        if (!lmp_field_find(field, lmp_vec3_element(&points, i), &place) ||
            memcmp(place.cell, last, sizeof last) == 0)
            continue;
        want_corners(field, place.cell);
        memcpy(last, place.cell, sizeof last);
    }
}

static lmp_result wanted_task(size_t brick, void *data) {
    lmp_field *field = data;
    if (state_of(field, brick) != FIELD_WANTED)
        return LMP_OK;
    (void)compute_task(brick, field);
    atomic_store_explicit(&field->states[brick], FIELD_READY, memory_order_relaxed);
    return LMP_OK;
}

lmp_result lmp_field_compute(const lmp_host *host, lmp_field *field) {
    const lmp_host resolved = lmp_host_resolve(host);
    return lmp_host_run(&resolved, 0, 1, field->brick_count, wanted_task, field);
}

lmp_result lmp_field_reset(lmp_field *field, const lmp_light *lights, size_t count) {
    if (count > (size_t)field->info.desc.light_max)
        return LMP_ERROR_ARGUMENT;
    assert(lmp_are_lights(lights, count));
    lmp_field_unlist_all(field);
    for (uint32_t i = 0; i < count; i++)
        lmp_field_set_light(field, i, &lights[i]);
    field->info.light_count = count;
    field->changed = 0;
    lmp_field_set_states(field, FIELD_STALE);
    return LMP_OK;
}

lmp_result lmp_field_update(const lmp_host *host, lmp_field *field, const lmp_light *lights,
                            size_t count) {
    const lmp_result result = lmp_field_reset(field, lights, count);
    if (result != LMP_OK)
        return result;
    lmp_field_set_states(field, FIELD_WANTED);
    return lmp_field_compute(host, field);
}

/* --- changes ---------------------------------------------------------------------------------- */

typedef struct change {
    lmp_field *field;
    lmp_kernel_lights lights; /* those taken away have negative radiance */
} field_change;

/* Every scratch_count-th brick, each by way of the task's own scratch. */
static void change_task(size_t index, void *data) {
    const field_change *change = data;
    const lmp_field *field = change->field;
    const size_t size = brick_size(field);
    float *scratch = field->scratch + index * size;
    for (size_t brick = index; brick < field->brick_count; brick += field->scratch_count) {
        float *nodes = field->nodes + brick * size;
        if (state_of(field, brick) != FIELD_READY)
            continue;
        compute(field, brick, &change->lights, scratch);
        for (size_t i = 0; i < size; i++)
            nodes[i] += scratch[i];
    }
}

static field_sphere negative(const field_sphere *sphere) {
    field_sphere taken = *sphere;
    taken.radiance = (lmp_rgb) { -taken.radiance.r, -taken.radiance.g, -taken.radiance.b };
    return taken;
}

/* The bricks whose turn it is, anew. */
static void refresh(lmp_field *field, size_t changed) {
    const uint64_t before = field->changed / LMP_FIELD_REFRESH;
    field->changed += changed;
    for (uint64_t turn = before; turn < field->changed / LMP_FIELD_REFRESH; turn++) {
        const size_t brick = (size_t)(turn % field->brick_count);
        if (state_of(field, brick) == FIELD_READY)
            (void)compute_task(brick, field);
    }
}

static void add_to_nodes(const lmp_host *host, lmp_field *field, const field_sphere *spheres,
                         size_t count) {
    const lmp_host resolved = lmp_host_resolve(host);
    field_change change = { field, kernel_lights(spheres, count) };
    resolved.parallel(field->scratch_count, change_task, &change, resolved.user);
}

void lmp_field_move(const lmp_host *host, lmp_field *field, const size_t *at,
                    const lmp_light *lights, size_t count) {
    assert(lmp_are_lights(lights, count));
    for (size_t first = 0; first < count; first += PASS) {
        const size_t some = count - first < PASS ? count - first : PASS;
        field_sphere spheres[2 * PASS];
        for (size_t i = 0; i < some; i++) {
            const uint32_t light = (uint32_t)at[first + i];
            assert(light < field->info.light_count);
            spheres[2 * i] = negative(&field->spheres[light]);
            lmp_field_unlist(field, light);
            lmp_field_set_light(field, light, &lights[first + i]);
            spheres[2 * i + 1] = field->spheres[light];
        }
        add_to_nodes(host, field, spheres, 2 * some);
        refresh(field, some);
    }
}

lmp_result lmp_field_add(const lmp_host *host, lmp_field *field, const lmp_light *light) {
    assert(lmp_is_light(light));
    const uint32_t at = (uint32_t)field->info.light_count;
    if (at >= (uint32_t)field->info.desc.light_max)
        return LMP_ERROR_ARGUMENT;
    lmp_field_set_light(field, at, light);
    field->info.light_count++;
    add_to_nodes(host, field, &field->spheres[at], 1);
    refresh(field, 1);
    return LMP_OK;
}

void lmp_field_remove(const lmp_host *host, lmp_field *field, size_t at) {
    assert(at < field->info.light_count);
    const uint32_t light = (uint32_t)at, last = (uint32_t)field->info.light_count - 1;
    const field_sphere gone = negative(&field->spheres[light]);
    lmp_field_unlist(field, light);
    if (light != last) {
        lmp_field_unlist(field, last);
        lmp_field_set_light(field, light, &field->lights[last]);
    }
    field->info.light_count--;
    add_to_nodes(host, field, &gone, 1);
    refresh(field, 1);
}
