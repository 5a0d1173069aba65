/* SPDX-License-Identifier: MIT */
/* One surface: what shading means. */
#include "src/shade/material.h"

/* The kernels' own: batches of one. */
static lmp_rgb shade_batch_of_one(const lmp_shade_settings *settings, const lmp_material *material,
                                  const lmp_surface *surface, const lmp_light *lights,
                                  size_t count) {
    const lmp_surfaces one = lmp_surfaces_of(material, surface);
    lmp_rgb color;
    lmp_shade_n(settings, &one, 1, lights, count, 0, &color.r);
    return color;
}

lmp_rgb lmp_shade(const lmp_shade_settings *settings, const lmp_material *material,
                  const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const lmp_shade_settings resolved = lmp_shade_resolve(settings);
    assert(lmp_is_material(material));
    assert(lmp_is_unit(surface->normal) && lmp_is_unit(surface->view));
    const shade_source source = lmp_shade_source(material, resolved.method);
    if (source.preintegrated || (!source.table && resolved.method == LMP_SHADE_PREINTEGRATED))
        return shade_batch_of_one(settings, material, surface, lights, count);
    return lmp_shade_sum(&resolved, material, surface, lights, count);
}
