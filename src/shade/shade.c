/* SPDX-License-Identifier: MIT */
/* One surface: what shading means. */
#include "src/shade/method.h"

/* The kernels' own: batches of one. */
static lmp_rgb shade_batch_of_one(const lmp_shade_settings *settings, const lmp_material *material,
                                  const lmp_surface *surface, const lmp_light *lights,
                                  size_t count) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_bare_n(settings, &one, 1, lights, count, 0, &color.r);
    return color;
}

static lmp_rgb shade_bare(const lmp_shade_settings *settings, const lmp_material *material,
                          const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const lmp_shade_settings resolved = lmp_shade_resolve(settings);
    const shade_method *method = lmp_shade_method_of(resolved.method);
    const shade_source source = lmp_shade_source(material, method->preintegrated);
    if (source.preintegrated || (!source.table && !method->lobes_of_one))
        return shade_batch_of_one(settings, material, surface, lights, count);
    return lmp_shade_sum(&resolved, material, surface, lights, count);
}

static lmp_rgb add_layers(const lmp_shade_settings *settings, const lmp_material *material,
                          shade_over over, const lmp_surface *surface, const lmp_light *lights,
                          size_t count, lmp_rgb under) {
    shade_layer layers[SHADE_LAYERS_MAX];
    lmp_surface own = *surface;
    if (over == SHADE_OVER_COAT)
        own.normal = *lmp_coat_normal(surface);
    const int layer_count = lmp_shade_layers_over(material, over, own.normal, own.view, layers);
    for (int i = 0; i < layer_count; i++)
        under = lmp_shade_add_layer(&layers[i], under,
                                    shade_bare(settings, &layers[i].material, &own, lights, count));
    return under;
}

lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                  const lmp_surface *surface, const lmp_light *lights, size_t count) {
    assert(lmp_is_material(material));
    assert(lmp_is_unit(surface->normal) && lmp_is_unit(surface->view));
    lmp_rgb color = shade_bare(settings, material, surface, lights, count);
    for (shade_over over = 0; over < SHADE_OVERS; over++)
        if (lmp_is_over(material, over))
            color = add_layers(settings, material, over, surface, lights, count, color);
    return color;
}

lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings, const lmp_material *material,
                              const lmp_surface *surface, const lmp_environment *environment) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_environment_n(settings, &one, 1, environment, 0, &color.r);
    return color;
}
