/* SPDX-License-Identifier: MIT */
/* One surface by the sums that define shading: a table's coefficients, or lobes. */
#include "src/shade/method.h"

static lmp_rgb clamped(lmp_rgb color) {
    return (lmp_rgb) { lmp_shade_clamped(color.r), lmp_shade_clamped(color.g),
                       lmp_shade_clamped(color.b) };
}

lmp_rgb lmp_shade_sum(const lmp_shade_settings *resolved, const lmp_material *material,
                      const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const shade_method *method = lmp_shade_method_of(resolved->method);
    const shade_source source = lmp_shade_source(material, method->preintegrated);
    if (source.table)
        return clamped(lmp_shade_table(source.table, surface, lights, count));
    shade_lobes lobes;
    lmp_shade_lobes(resolved, material, surface, method->diffuse_by_bands, &lobes);
    return clamped(method->lobes_of_one(&lobes, surface->position, lights, count));
}
