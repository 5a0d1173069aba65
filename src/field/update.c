/* SPDX-License-Identifier: MIT */
/* update.c - updates a field when its lights change. */
#include "src/field/update.h"

#include "src/field/near.h"
#include "src/field/nodes.h"
#include "src/light/packed.h"
#include "src/light/valid.h"

#include <math.h>
#include <string.h>

/* Lights that one pass over the nodes adds and takes away, at most. */
enum { PASS = 16 };

/* --- lights ----------------------------------------------------------------------------------- */

static field_sphere sphere_of(const lmp_light *light) {
    lmpi_packed_light packed;
    if (!lmpi_light_fades(light))
        return (field_sphere) { .radius = 0 };
    lmpi_light_pack(light, &packed);
    return (field_sphere) { packed.at, packed.size, packed.color };
}

static void set_light(lmp_field *field, uint32_t at, const lmp_light *light) {
    field->lights[at] = *light;
    field->spheres[at] = sphere_of(light);
}

static void list_light(lmp_field *field, uint32_t at, const lmp_light *light) {
    set_light(field, at, light);
    lmpi_field_list(field, at);
}

static void relist_light(lmp_field *field, uint32_t at, const lmp_light *light) {
    const field_sphere was = field->spheres[at];
    set_light(field, at, light);
    lmpi_field_relist(field, at, &was);
}

static void set_count(lmp_field *field, size_t count) {
    for (lmp_field *level = field; level; level = level->coarse)
        level->info.light_count = count;
}

void lmpi_field_push_light(lmp_field *field, const lmp_light *light) {
    list_light(field, (uint32_t)field->info.light_count, light);
    set_count(field, field->info.light_count + 1);
}

lmp_result lmp_field_reset(lmp_field *field, const lmp_light *lights, size_t count) {
    if (count > field->info.desc.light_max || lmpi_is_any_area(lights, count))
        return LMP_ERROR_ARGUMENT;
    assert(lmpi_are_lights(lights, count));
    lmpi_field_unlist_all(field);
    set_count(field, 0);
    for (size_t i = 0; i < count; i++)
        lmpi_field_push_light(field, &lights[i]);
    field->changed = 0;
    lmpi_field_set_states(field, FIELD_STALE);
    return LMP_OK;
}

lmp_result lmp_field_update(const lmp_host *host, lmp_field *field, const lmp_light *lights,
                            size_t count) {
    const lmp_result result = lmp_field_reset(field, lights, count);
    if (result != LMP_OK)
        return result;
    lmpi_field_set_states(field, FIELD_WANTED);
    return lmp_field_compute(host, field);
}

/* --- changes ---------------------------------------------------------------------------------- */

static field_sphere negative(const field_sphere *sphere) {
    field_sphere taken = *sphere;
    taken.radiance = (lmp_rgb) { -taken.radiance.r, -taken.radiance.g, -taken.radiance.b };
    return taken;
}

/* Recomputes the bricks whose turn it is. */
static void refresh(lmp_field *field, size_t changed) {
    const uint64_t before = field->changed / LMP_FIELD_REFRESH;
    field->changed += changed;
    for (uint64_t turn = before; turn < field->changed / LMP_FIELD_REFRESH; turn++)
        lmpi_field_refresh(field, turn);
}

void lmp_field_move_n(const lmp_host *host, lmp_field *field, const size_t *at,
                      const lmp_light *lights, size_t count) {
    assert(lmpi_are_lights(lights, count) && !lmpi_is_any_area(lights, count));
    for (size_t first = 0; first < count; first += PASS) {
        const size_t some = count - first < PASS ? count - first : PASS;
        field_sphere spheres[2 * PASS];
        for (size_t i = 0; i < some; i++) {
            const uint32_t light = (uint32_t)at[first + i];
            assert(light < field->info.light_count);
            spheres[2 * i] = negative(&field->spheres[light]);
            relist_light(field, light, &lights[first + i]);
            spheres[2 * i + 1] = field->spheres[light];
        }
        lmpi_field_add_spheres(host, field, spheres, 2 * some);
        refresh(field, some);
    }
}

lmp_result lmp_field_add(const lmp_host *host, lmp_field *field, const lmp_light *light) {
    assert(lmpi_is_light(light));
    const uint32_t at = (uint32_t)field->info.light_count;
    if (at >= field->info.desc.light_max || lmpi_is_any_area(light, 1))
        return LMP_ERROR_ARGUMENT;
    lmpi_field_push_light(field, light);
    lmpi_field_add_spheres(host, field, &field->spheres[at], 1);
    refresh(field, 1);
    return LMP_OK;
}

void lmp_field_remove(const lmp_host *host, lmp_field *field, size_t at) {
    assert(at < field->info.light_count);
    const uint32_t light = (uint32_t)at, last = (uint32_t)field->info.light_count - 1;
    const field_sphere gone = negative(&field->spheres[light]);
    lmpi_field_unlist(field, light);
    if (light != last) {
        lmpi_field_unlist(field, last);
        list_light(field, light, &field->lights[last]);
    }
    set_count(field, last);
    lmpi_field_add_spheres(host, field, &gone, 1);
    refresh(field, 1);
}
