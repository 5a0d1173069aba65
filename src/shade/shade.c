/* SPDX-License-Identifier: MIT */
/* shade.c - shades one surface, which defines what shading means. */
#include "src/shade/method.h"

/* Shades one surface by the kernels, as a batch of one. */
static lmp_rgb shade_batch_of_one(const lmp_shade_settings *settings, const lmp_material *material,
                                  const lmp_surface *surface, const lmp_light *lights,
                                  size_t count) {
    const lmp_surfaces one = lmpi_surfaces_of(material, surface);
    lmp_rgb color;
    lmpi_shade_bare_n(settings, &one, 1, lights, count, sizeof color, &color.r);
    return color;
}

static lmp_rgb shade_bare(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const lmp_shade_settings resolved = lmpi_shade_resolve(settings);
    const shade_method *method = lmpi_shade_method_of(resolved.method);
    const shade_source source = lmpi_shade_source(material, method->preintegrated);
    if (source.preintegrated || (!source.table && !method->lobes_of_one))
        return shade_batch_of_one(settings, material, surface, lights, count);
    return lmpi_shade_sum(&resolved, material, surface, lights, count);
}

static lmp_rgb add_layers(const lmp_shade_settings *settings, const lmp_material *material,
                          shade_layer_kind kind, const lmp_surface *surface,
                          const lmp_light *lights, size_t count, lmp_rgb under) {
    shade_layer layers[SHADE_LAYERS_MAX];
    lmp_surface own = *surface;
    if (kind == SHADE_LAYER_COAT)
        own.normal = *lmpi_coat_normal(surface);
    const int layer_count = lmpi_shade_layers_over(material, kind, own.normal, own.view, layers);
    for (int i = 0; i < layer_count; i++)
        under = lmpi_shade_add_layer(
            &layers[i], under, shade_bare(settings, &layers[i].material, &own, lights, count));
    return under;
}

lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                  const lmp_surface *surface, const lmp_light *lights, size_t count) {
    assert(lmpi_is_material(material));
    assert(lmpi_is_unit(surface->normal) && lmpi_is_unit(surface->view));
    lmp_rgb color = shade_bare(settings, material, surface, lights, count);
    for (shade_layer_kind kind = 0; kind < SHADE_LAYER_KINDS; kind++)
        if (lmpi_has_layer(material, kind))
            color = add_layers(settings, material, kind, surface, lights, count, color);
    return color;
}

lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings, const lmp_material *material,
                              const lmp_surface *surface, const lmp_environment *environment) {
    const lmp_surfaces one = lmpi_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_environment_n(settings, &one, 1, environment, lmp_rgb_array_of(&color));
    return color;
}
