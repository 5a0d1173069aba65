/* SPDX-License-Identifier: MIT */
/* sum.c - shades one surface by the sums that define shading: of a table's coefficients, or of
 * lobes. */
#include "src/shade/method.h"

static lmp_rgb clamped(lmp_rgb color) {
    return (lmp_rgb) { lmpi_shade_clamped(color.r), lmpi_shade_clamped(color.g),
                       lmpi_shade_clamped(color.b) };
}

lmp_rgb lmpi_shade_sum(const lmp_shade_settings *resolved, const lmp_material *material,
                       const lmp_surface *surface, const lmp_light *lights, size_t count) {
    const shade_method *method = lmpi_shade_method_of(resolved->method);
    const shade_source source = lmpi_shade_source(material, method->preintegrated);
    if (source.table)
        return clamped(lmpi_shade_table(source.table, surface, lights, count));
    shade_lobes lobes;
    lmpi_shade_lobes(resolved, material, surface, method->diffuse_by_bands, &lobes);
    return clamped(method->lobes_of_one(&lobes, surface->position, lights, count));
}
