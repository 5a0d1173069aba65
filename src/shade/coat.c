/* SPDX-License-Identifier: MIT */
/* coat.c - clear coats: what is under one, weakened by it, and a material of GGX alone over it. */
#include "src/shade/material.h"

#include <math.h>
#include <string.h>

float lmp_material_coated(const lmp_coat *coat, lmp_vec3 n, lmp_vec3 v) {
    const float along = fabsf(n.x * v.x + n.y * v.y + n.z * v.z), grazing = 1 - fminf(along, 1);
    const float square = grazing * grazing;
    const float rest = 1 - LMP_DIELECTRIC_F0;
    return coat->weight * (LMP_DIELECTRIC_F0 + rest * (square * square * grazing));
}

lmp_material lmp_coat_material(const lmp_coat *coat, float part) {
    return (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                            .roughness = coat->roughness,
                            .dielectric = { true, { part, part, part }, part } };
}

/* --- many surfaces ---------------------------------------------------------------------------- */

/* What shines on them: lights, or an environment. */
typedef struct coat_light {
    const lmp_shade_settings *settings;
    const lmp_light *lights;
    size_t light_count;
    const lmp_environment *environment;
} coat_light;

static void shade_uncoated(const coat_light *light, const lmp_surfaces *surfaces, size_t count,
                           size_t stride, float *rgb) {
    if (light->environment)
        lmp_shade_environment_uncoated_n(light->settings, surfaces, count, light->environment,
                                         stride, rgb);
    else
        lmp_shade_uncoated_n(light->settings, surfaces, count, light->lights, light->light_count,
                             stride, rgb);
}

/* Coats of some surfaces: as many as the stack has room for. */
enum { COATS = 8 };
typedef struct coats {
    size_t count, at[COATS]; /* among the caller's */
    lmp_material material[COATS];
    lmp_vec3 position[COATS], normal[COATS], view[COATS];
    float part[COATS];
} coats;

static lmp_vec3_array tight(const lmp_vec3 *vectors) {
    return (lmp_vec3_array) { &vectors->x, &vectors->y, &vectors->z, sizeof *vectors };
}

/* Goes on from `next` until there is no room; returns where it came. */
static size_t take_coats(const lmp_surfaces *surfaces, bool positions, size_t next, size_t count,
                         coats *taken) {
    const lmp_vec3_array *normals =
        surfaces->coat_normal.x ? &surfaces->coat_normal : &surfaces->normal;
    taken->count = 0;
    for (; taken->count < COATS; next++) {
        while (next < count && !(lmp_material_at(surfaces, next)->coat.weight > 0))
            next++;
        if (next == count)
            break;
        const lmp_coat *coat = &lmp_material_at(surfaces, next)->coat;
        const size_t k = taken->count++;
        taken->at[k] = next;
        taken->normal[k] = lmp_vec3_element(normals, next);
        taken->view[k] = lmp_vec3_element(&surfaces->view, next);
        if (positions)
            taken->position[k] = lmp_vec3_element(&surfaces->position, next);
        taken->part[k] = lmp_material_coated(coat, taken->normal[k], taken->view[k]);
        taken->material[k] = lmp_coat_material(coat, taken->part[k]);
    }
    return next;
}

/* A function of its own: the kernels' planes and these take turns on the stack. */
static void add_coats(const coat_light *light, const coats *taken, size_t stride, float *rgb) {
    const lmp_surfaces over = { .position = tight(taken->position),
                                .normal = tight(taken->normal),
                                .view = tight(taken->view),
                                .material = taken->material,
                                .material_stride = sizeof *taken->material };
    lmp_rgb reflected[COATS];
    shade_uncoated(light, &over, taken->count, sizeof *reflected, &reflected->r);
    for (size_t k = 0; k < taken->count; k++) {
        char *to = (char *)rgb + taken->at[k] * stride;
        lmp_rgb color;
        memcpy(&color, to, sizeof color);
        color.r = color.r * (1 - taken->part[k]) + reflected[k].r;
        color.g = color.g * (1 - taken->part[k]) + reflected[k].g;
        color.b = color.b * (1 - taken->part[k]) + reflected[k].b;
        memcpy(to, &color, sizeof color);
    }
}

static void shade_coated(const coat_light *light, const lmp_surfaces *surfaces, size_t count,
                         size_t rgb_stride, float *rgb) {
    const size_t stride = rgb_stride ? rgb_stride : sizeof(lmp_rgb);
    shade_uncoated(light, surfaces, count, stride, rgb);
    for (size_t next = 0; next < count;) {
        coats taken;
        next = take_coats(surfaces, !light->environment, next, count, &taken);
        if (taken.count > 0)
            add_coats(light, &taken, stride, rgb);
    }
}

void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces, size_t count,
                 const lmp_light *lights, size_t light_count, size_t rgb_stride, float *rgb) {
    const coat_light light = { settings, lights, light_count, NULL };
    shade_coated(&light, surfaces, count, rgb_stride, rgb);
}

void lmp_shade_environment_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                             size_t count, const lmp_environment *environment, size_t rgb_stride,
                             float *rgb) {
    const coat_light light = { settings, NULL, 0, environment };
    shade_coated(&light, surfaces, count, rgb_stride, rgb);
}
