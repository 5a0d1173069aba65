/* SPDX-License-Identifier: MIT */
/* coat.glsl - a clear coat, KHR_materials_clearcoat, over any surface: lmp_coat of lampion/shade.h.
 * Include it after ggx.glsl and lampion.glsl (without them it has lmp_coated alone). What a coated
 * surface reflects:
 *
 *     lmp_surface over = lmp_surface(surface.position, coat_normal, surface.view);
 *     float part = lmp_coated(coat, over.normal, over.view);
 *     color = (1.0 - part) * (lmp_shade_zonal(surface, material) + emitted) +
 *             lmp_shade_zonal(over, lmp_lobes_of(over, coat));
 */
#ifndef LAMPION_COAT_GLSL
#define LAMPION_COAT_GLSL

/* weight in 0 … 1 */
struct lmp_coat {
    float weight, roughness;
};

/* Returns the fraction of the light that the coat reflects; normal is the coat's own. */
float lmp_coated(lmp_coat coat, vec3 normal, vec3 view) {
    float grazing = 1.0 - min(abs(dot(normal, view)), 1.0), square = grazing * grazing;
    return coat.weight * (0.04 + 0.96 * (square * square * grazing));
}

#ifdef LAMPION_GGX_GLSL
/* Returns the lobes of a coat: GGX without a base. */
lmp_lobes lmp_lobes_of(lmp_surface over, lmp_coat coat) {
    float part = lmp_coated(coat, over.normal, over.view);
    return lmp_lobes_of(over, lmp_metallic_roughness(vec3(0.0), 0.0, coat.roughness),
                        lmp_dielectric(vec3(part), part));
}
#endif

#endif
