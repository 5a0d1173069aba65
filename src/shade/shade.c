/* SPDX-License-Identifier: MIT */
/* One surface: what shading means. */
#include "src/shade/method.h"

/* The kernels' own: batches of one. */
static lmp_rgb shade_batch_of_one(const lmp_shade_settings *settings, const lmp_material *material,
                                  const lmp_surface *surface, const lmp_light *lights,
                                  size_t count) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_uncoated_n(settings, &one, 1, lights, count, 0, &color.r);
    return color;
}

static lmp_rgb shade_uncoated(const lmp_shade_settings *settings, const lmp_material *material,
                              const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const lmp_shade_settings resolved = lmp_shade_resolve(settings);
    const shade_method *method = lmp_shade_method_of(resolved.method);
    const shade_source source = lmp_shade_source(material, method->preintegrated);
    if (source.preintegrated || (!source.table && !method->lobes_of_one))
        return shade_batch_of_one(settings, material, surface, lights, count);
    return lmp_shade_sum(&resolved, material, surface, lights, count);
}

lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                  const lmp_surface *surface, const lmp_light *lights, size_t count) {
    assert(lmp_is_material(material));
    assert(lmp_is_unit(surface->normal) && lmp_is_unit(surface->view));
    const lmp_rgb under = shade_uncoated(settings, material, surface, lights, count);
    if (!(material->coat.weight > 0))
        return under;
    lmp_surface over = *surface;
    over.normal = *lmp_coat_normal(surface);
    const float part = lmp_material_coated(&material->coat, over.normal, over.view);
    const lmp_material coat = lmp_coat_material(&material->coat, part);
    const lmp_rgb reflected = shade_uncoated(settings, &coat, &over, lights, count);
    return (lmp_rgb) { under.r * (1 - part) + reflected.r, under.g * (1 - part) + reflected.g,
                       under.b * (1 - part) + reflected.b };
}

lmp_rgb lmp_shade_environment(const lmp_shade_settings *settings, const lmp_material *material,
                              const lmp_surface *surface, const lmp_environment *environment) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_environment_n(settings, &one, 1, environment, 0, &color.r);
    return color;
}
