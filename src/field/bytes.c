/* SPDX-License-Identifier: MIT */
/* bytes.c - the file format .lmpf (docs/formats.md): the grid, the lights, then the nodes. */
#include "src/base/bytes.h"
#include "src/base/parse_error.h"

#include "src/field/field.h"
#include "src/field/nodes.h"
#include "src/field/update.h"
#include "src/light/packed.h"
#include "src/light/valid.h"

#include <string.h>

enum { HEADER = 64, LIGHT = 4 * 17 };

static const lmpi_bytes_format format = { .name = "field (.lmpf)",
                                          .magic = { 'L', 'M', 'P', 'F', 0x0d, 0x0a, 0x1a, 0x0a },
                                          .version = 1,
                                          .header = HEADER };

/* Returns the nodes of the grid alone: nodes that only fill the last bricks are never read. */
static size_t node_count(const lmp_field_desc *desc) {
    return (size_t)desc->nodes[0] * (size_t)desc->nodes[1] * (size_t)desc->nodes[2];
}

static size_t file_size(const lmp_field_desc *desc, size_t lights) {
    return HEADER + LIGHT * lights + 48 * LMP_SH_COUNT(desc->bands) * node_count(desc) +
           LMPI_BYTES_CHECKSUM;
}

size_t lmp_field_size(const lmp_field *field) {
    return file_size(&field->info.desc, field->info.light_count);
}

/* --- writing ---------------------------------------------------------------------------------- */

static unsigned char *store_vector(unsigned char *p, float x, float y, float z) {
    return lmpi_bytes_store_f32(lmpi_bytes_store_f32(lmpi_bytes_store_f32(p, x), y), z);
}

static unsigned char *store_light(unsigned char *p, const lmp_light *light) {
    const lmp_vec3 at = light->position, to = light->direction;
    const float numbers[4] = { light->radius, light->angle, light->inner, light->outer };
    p = lmpi_bytes_store_u32(p, (uint32_t)light->kind);
    p = store_vector(p, at.x, at.y, at.z);
    p = store_vector(p, to.x, to.y, to.z);
    for (int i = 0; i < 4; i++)
        p = lmpi_bytes_store_f32(p, numbers[i]);
    p = store_vector(p, light->radiance.r, light->radiance.g, light->radiance.b);
    return store_vector(p, light->ground.r, light->ground.g, light->ground.b);
}

/* Finds node i of the grid, x varying fastest. */
static float *node_at(const lmp_field *field, size_t i) {
    const size_t x = (size_t)field->info.desc.nodes[0], y = (size_t)field->info.desc.nodes[1];
    const uint32_t node =
        lmpi_field_node(field, (uint32_t)(i % x), (uint32_t)(i / x % y), (uint32_t)(i / x / y));
    return field->nodes + 4 * field->stride * node;
}

lmp_result lmp_field_write(const lmp_field *field, size_t size, void *bytes) {
    const lmp_field_desc *desc = &field->info.desc;
    if (size < lmp_field_size(field))
        return LMP_ERROR_ARGUMENT;
    unsigned char *p = lmpi_bytes_begin(bytes, &format);
    p = lmpi_bytes_store_u32(p, (uint32_t)desc->bands);
    for (int a = 0; a < 3; a++)
        p = lmpi_bytes_store_u32(p, (uint32_t)desc->nodes[a]);
    p = store_vector(p, desc->origin.x, desc->origin.y, desc->origin.z);
    p = store_vector(p, desc->cell.x, desc->cell.y, desc->cell.z);
    p = lmpi_bytes_store_f32(p, desc->reach);
    p = lmpi_bytes_store_u32(p, (uint32_t)desc->light_max);
    p = lmpi_bytes_store_u32(p, (uint32_t)field->info.light_count);
    for (size_t i = 0; i < field->info.light_count; i++)
        p = store_light(p, &field->lights[i]);
    for (size_t i = 0; i < node_count(desc); i++) {
        const float *node = node_at(field, i);
        for (size_t row = 0; row < 4; row++)
            for (size_t v = 0; v < field->values; v++)
                p = lmpi_bytes_store_f32(p, node[row * field->stride + v]);
    }
    lmpi_bytes_end(bytes, p);
    return LMP_OK;
}

/* --- reading ---------------------------------------------------------------------------------- */

static lmp_vec3 load_vector(const unsigned char **p) {
    const float x = lmpi_bytes_load_f32(p), y = lmpi_bytes_load_f32(p);
    return (lmp_vec3) { x, y, lmpi_bytes_load_f32(p) };
}

static lmp_rgb load_color(const unsigned char **p) {
    const lmp_vec3 v = load_vector(p);
    return (lmp_rgb) { v.x, v.y, v.z };
}

/* Loads a light; returns false if it is not valid. */
static bool load_light(const unsigned char **p, lmp_light *light) {
    const uint32_t kind = lmpi_bytes_load_u32(p);
    *light = (lmp_light) { .position = load_vector(p) };
    light->direction = load_vector(p);
    light->radius = lmpi_bytes_load_f32(p);
    light->angle = lmpi_bytes_load_f32(p);
    light->inner = lmpi_bytes_load_f32(p);
    light->outer = lmpi_bytes_load_f32(p);
    light->radiance = load_color(p);
    light->ground = load_color(p);
    if (kind >= LMP_LIGHT_KIND_COUNT)
        return false;
    light->kind = (lmp_light_kind)kind;
    return !lmpi_light_is_area(light) && lmpi_is_light(light);
}

static int load_count(const unsigned char **p) {
    const uint32_t count = lmpi_bytes_load_u32(p);
    return count <= INT32_MAX ? (int)count : -1;
}

/* Loads a desc in which no member is left to its default. */
static bool load_desc(const unsigned char *bytes, lmp_field_desc *desc, size_t *lights) {
    const unsigned char *p = bytes + LMPI_BYTES_BEGIN;
    desc->bands = load_count(&p);
    bool given = desc->bands != 0;
    for (int a = 0; a < 3; a++) {
        desc->nodes[a] = load_count(&p);
        given = given && desc->nodes[a] != 0;
    }
    desc->origin = load_vector(&p);
    desc->cell = load_vector(&p);
    desc->reach = lmpi_bytes_load_f32(&p);
    desc->light_max = lmpi_bytes_load_u32(&p);
    *lights = lmpi_bytes_load_u32(&p);
    given = given && desc->cell.x > 0 && desc->reach > 0 && desc->light_max != 0;
    return given && lmpi_field_resolve(desc) && *lights <= desc->light_max;
}

/* Finds the first number that is not finite, or the end. */
static const unsigned char *first_not_finite(const unsigned char *p, const unsigned char *end) {
    while (p < end && (lmpi_bytes_at_u32(p) & 0x7f800000u) != 0x7f800000u)
        p += 4;
    return p;
}

static lmp_result load_lights(const unsigned char **p, size_t count, lmp_field *field,
                              lmp_parse_error *error) {
    for (size_t i = 0; i < count; i++) {
        lmp_light light;
        if (!load_light(p, &light))
            return lmpi_parse_fail(error, LMP_ERROR_FORMAT, HEADER + LIGHT * i,
                                   "light %zu is not valid", i);
        lmpi_field_push_light(field, &light);
    }
    return LMP_OK;
}

static void load_nodes(const unsigned char *p, lmp_field *field) {
    for (size_t i = 0; i < node_count(&field->info.desc); i++) {
        float *node = node_at(field, i);
        for (size_t row = 0; row < 4; row++)
            for (size_t v = 0; v < field->values; v++)
                node[row * field->stride + v] = lmpi_bytes_load_f32(&p);
    }
}

/* Loads the lights and the nodes. A coarser field is not in the file: it is computed from the
 * lights. */
static lmp_result load(const lmp_host *host, const unsigned char *p, size_t lights,
                       lmp_field *field, lmp_parse_error *error) {
    const lmp_result result = load_lights(&p, lights, field, error);
    if (result != LMP_OK)
        return result;
    load_nodes(p, field);
    if (!field->coarse)
        return LMP_OK;
    lmpi_field_set_states(field->coarse, FIELD_WANTED);
    const lmp_result computed = lmp_field_compute(host, field->coarse);
    if (computed != LMP_OK)
        lmpi_parse_fail(error, computed, 0, "the coarser field was not computed");
    return computed;
}

lmp_result lmp_field_read(const lmp_host *host, const void *data, size_t size,
                          lmp_parse_error *error, lmp_field **field) {
    const unsigned char *bytes = data;
    lmp_field_desc desc = { 0 };
    size_t lights;
    *field = NULL;
    lmp_result result = lmpi_bytes_check_frame(bytes, size, &format, error);
    if (result != LMP_OK)
        return result;
    if (!load_desc(bytes, &desc, &lights) || size != file_size(&desc, lights))
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, LMPI_BYTES_BEGIN,
                               "a member of the grid is out of range, or its nodes and lights do "
                               "not make %zu bytes",
                               size);
    const unsigned char *p = bytes + HEADER, *end = bytes + size - LMPI_BYTES_CHECKSUM;
    const unsigned char *wrong = first_not_finite(p + LIGHT * lights, end);
    if (wrong < end)
        return lmpi_parse_fail(error, LMP_ERROR_FORMAT, (size_t)(wrong - bytes),
                               "a node's coefficient is not a finite number");
    result = lmpi_field_allocate(host, &desc, field);
    if (result != LMP_OK)
        return lmpi_parse_fail(error, result, 0, "out of memory for the field");
    result = load(host, p, lights, *field, error);
    if (result != LMP_OK) {
        lmp_field_destroy(*field);
        *field = NULL;
    }
    return result;
}
