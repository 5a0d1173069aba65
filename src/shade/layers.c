/* SPDX-License-Identifier: MIT */
/* layers.c - the layers that lie over a material and weaken it: sheen, shaded by two tables of
 * white sheen, and over them a clear coat, shaded by a material of GGX alone. */
#include "src/brdf/table.h"
#include "src/shade/material.h"

#include <math.h>
#include <string.h>

static const float pi = 3.14159265f;

float lmp_material_coat_reflectance(const lmp_coat *coat, lmp_vec3 n, lmp_vec3 v) {
    const float along = fabsf(n.x * v.x + n.y * v.y + n.z * v.z), grazing = 1 - fminf(along, 1);
    const float square = grazing * grazing;
    const float rest = 1 - LMP_DIELECTRIC_F0;
    return coat->weight * (LMP_DIELECTRIC_F0 + rest * (square * square * grazing));
}

static int coat_over(const lmp_coat *coat, lmp_vec3 n, lmp_vec3 v, shade_layer *layer) {
    const float part = lmp_material_coat_reflectance(coat, n, v);
    layer->material = (lmp_material) { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS,
                                       .roughness = coat->roughness,
                                       .dielectric = { true, { part, part, part }, part } };
    layer->weight = (lmp_rgb) { 1, 1, 1 };
    layer->left = 1 - part;
    return 1;
}

/* Returns the fraction of a uniform sky that white sheen reflects; coefficient 0 holds the mean
 * over all directions. */
static float albedo(const lmp_brdf_table *white, float cosine) {
    float mean[3];
    lmpi_brdf_table_bands(white, cosine, 0, 0, 1, mean);
    return mean[0] * sqrtf(4 * pi);
}

/* Finds the two layers of sheen between whose roughnesses the sheen's lies. */
static int sheen_over(const lmp_sheen_layer *sheen, lmp_vec3 n, lmp_vec3 v, shade_layer layers[2]) {
    const float least = LMP_SHEEN_ROUGHNESS_MIN, last = LMP_SHEEN_TABLES - 1;
    const float at = (sheen->roughness - least) / (1 - least) * last;
    const float held = at > 0 ? fminf(at, last) : 0; /* NaN becomes the least */
    const int first = held < last ? (int)held : LMP_SHEEN_TABLES - 2;
    const float parts[2] = { 1 - (held - (float)first), held - (float)first };
    const float cosine = n.x * v.x + n.y * v.y + n.z * v.z;
    const lmp_rgb color = sheen->color;
    float reflected = 0;
    for (int i = 0; i < 2; i++) {
        const lmp_brdf_table *white = sheen->white[first + i];
        layers[i].material = (lmp_material) { .kind = LMP_MATERIAL_TABLE, .table = white };
        layers[i].weight = (lmp_rgb) { color.r * parts[i], color.g * parts[i], color.b * parts[i] };
        layers[i].left = 1;
        reflected += parts[i] * albedo(white, cosine);
    }
    layers[0].left = fmaxf(1 - fmaxf(color.r, fmaxf(color.g, color.b)) * reflected, 0);
    return 2;
}

int lmpi_shade_layers_over(const lmp_material *material, shade_layer_kind kind, lmp_vec3 normal,
                           lmp_vec3 view, shade_layer layers[SHADE_LAYERS_MAX]) {
    return kind == SHADE_LAYER_COAT ? coat_over(&material->coat, normal, view, layers)
                                    : sheen_over(&material->sheen, normal, view, layers);
}

/* --- many surfaces ---------------------------------------------------------------------------- */

/* The light that shines on the surfaces. */
typedef struct layers_light {
    shade_bare_n *bare;
    const void *light;
    bool positions; /* whether surfaces' positions are read */
} layers_light;

/* Layers over some surfaces: as many as the stack has room for. */
enum { TAKEN = 6 };
typedef struct taken_layers {
    size_t count, at[TAKEN]; /* indices among the caller's surfaces */
    lmp_material material[TAKEN];
    lmp_vec3 position[TAKEN], normal[TAKEN], view[TAKEN];
    lmp_rgb weight[TAKEN];
    float left[TAKEN];
} taken_layers;

static lmp_vec3_array tight(const lmp_vec3 *vectors) {
    return (lmp_vec3_array) { &vectors->x, &vectors->y, &vectors->z, sizeof *vectors };
}

static void take_surface(const lmp_surfaces *surfaces, bool positions, shade_layer_kind kind,
                         size_t i, taken_layers *taken) {
    const bool own = kind == SHADE_LAYER_COAT && surfaces->coat_normal.x;
    const lmp_vec3 normal = lmpi_vec3_element(own ? &surfaces->coat_normal : &surfaces->normal, i);
    const lmp_vec3 view = lmpi_vec3_element(&surfaces->view, i);
    shade_layer layers[SHADE_LAYERS_MAX];
    const int count =
        lmpi_shade_layers_over(lmpi_material_at(surfaces, i), kind, normal, view, layers);
    for (int l = 0; l < count; l++) {
        const size_t k = taken->count++;
        taken->at[k] = i;
        taken->normal[k] = normal;
        taken->view[k] = view;
        if (positions)
            taken->position[k] = lmpi_vec3_element(&surfaces->position, i);
        taken->material[k] = layers[l].material;
        taken->weight[k] = layers[l].weight;
        taken->left[k] = layers[l].left;
    }
}

/* Takes layers from surface `next` on until there is no room; returns the surface to go on with. */
static size_t take_layers(const lmp_surfaces *surfaces, bool positions, shade_layer_kind kind,
                          size_t next, size_t count, taken_layers *taken) {
    taken->count = 0;
    for (; next < count && taken->count + SHADE_LAYERS_MAX <= TAKEN; next++)
        if (lmpi_has_layer(lmpi_material_at(surfaces, next), kind))
            take_surface(surfaces, positions, kind, next, taken);
    return next;
}

/* Adds the light that the layers reflect. It is a function of its own, so that its arrays and the
 * kernels' planes take turns on the stack. */
static void add_layers(const layers_light *light, const taken_layers *taken, size_t stride,
                       float *rgb) {
    const lmp_surfaces over = { .position = tight(taken->position),
                                .normal = tight(taken->normal),
                                .view = tight(taken->view),
                                .material = taken->material,
                                .material_stride = sizeof *taken->material };
    lmp_rgb reflected[TAKEN];
    light->bare(light->light, &over, taken->count, sizeof *reflected, &reflected->r);
    for (size_t k = 0; k < taken->count; k++) {
        const shade_layer layer = { .weight = taken->weight[k], .left = taken->left[k] };
        char *to = (char *)rgb + taken->at[k] * stride;
        lmp_rgb color;
        memcpy(&color, to, sizeof color);
        color = lmpi_shade_add_layer(&layer, color, reflected[k]);
        memcpy(to, &color, sizeof color);
    }
}

void lmpi_shade_layered(shade_bare_n *bare, const void *light, bool positions,
                        const lmp_surfaces *surfaces, size_t count, lmp_rgb_array rgb) {
    assert(lmpi_is_rgb_array(rgb));
    const layers_light shining = { bare, light, positions };
    const size_t stride = rgb.stride ? rgb.stride : sizeof(lmp_rgb);
    const unsigned layer_mask = bare(light, surfaces, count, stride, rgb.at);
    for (shade_layer_kind kind = 0; kind < SHADE_LAYER_KINDS; kind++)
        for (size_t next = layer_mask >> kind & 1 ? 0 : count; next < count;) {
            taken_layers taken;
            next = take_layers(surfaces, positions, kind, next, count, &taken);
            if (taken.count > 0)
                add_layers(&shining, &taken, stride, rgb.at);
        }
}

typedef struct shade_lights {
    const lmp_shade_settings *settings;
    const lmp_light *lights;
    size_t count;
} shade_lights;

static unsigned shade_under_lights(const void *light, const lmp_surfaces *surfaces, size_t count,
                                   size_t stride, float *rgb) {
    const shade_lights *lights = light;
    return lmpi_shade_bare_n(lights->settings, surfaces, count, lights->lights, lights->count,
                             stride, rgb);
}

void lmp_shade_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces, size_t count,
                 const lmp_light *lights, size_t light_count, lmp_rgb_array rgb) {
    const shade_lights light = { settings, lights, light_count };
    lmpi_shade_layered(shade_under_lights, &light, true, surfaces, count, rgb);
}

typedef struct shade_surroundings {
    const lmp_shade_settings *settings;
    const lmp_environment *environment;
} shade_surroundings;

static unsigned shade_under_environment(const void *light, const lmp_surfaces *surfaces,
                                        size_t count, size_t stride, float *rgb) {
    const shade_surroundings *around = light;
    return lmpi_shade_environment_bare_n(around->settings, surfaces, count, around->environment,
                                         stride, rgb);
}

void lmp_shade_environment_n(const lmp_shade_settings *settings, const lmp_surfaces *surfaces,
                             size_t count, const lmp_environment *environment, lmp_rgb_array rgb) {
    const shade_surroundings light = { settings, environment };
    lmpi_shade_layered(shade_under_environment, &light, false, surfaces, count, rgb);
}
