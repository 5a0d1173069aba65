/* SPDX-License-Identifier: MIT */
/* Shades with one thread per pixel: G-buffer in, radiance out. SHADE is the method; all methods
 * have one signature. PIXEL_LAYERED: some materials have a coat. PIXEL_TRANSLUCENT: some let light
 * through. PIXEL_SHEEN: sheen.comp ran before. SHADE_AREAS: some lights are areas. */
#include "gbuffer.glsl"
#include "shared.h"

#include "light.glsl"
#ifdef SHADE_TABULATED_Z
#define LMP_CAP_SERIES
#endif
#include "material.glsl"
#ifdef SHADE_AREAS
#include "areas.glsl"
#endif
#include "lampion.glsl"
#ifdef SHADE_TABULATED_Z
#include "tabulated.glsl"
#endif
#include "coefficients.glsl"
#ifdef SHADE_AREAS
#include "area.glsl"
#endif

#ifdef SHADE_PREINTEGRATED
layout(binding = SHARED_PREINTEGRATED_LOBE_PAIRS) uniform sampler2D lobe_pairs;
layout(std430, binding = SHARED_PREINTEGRATED_LOBE) readonly buffer lobe_block {
    vec4 shape;
    vec4 cells[SHARED_PREINTEGRATED_LOBE_CELLS];
    float remap[SHARED_PREINTEGRATED_LOBE_REMAP];
};
#define LMP_PREINTEGRATED_LOBE_PAIR(p) textureLod(lobe_pairs, (p) * shape.zw, 0.0).rg
#define LMP_PREINTEGRATED_LOBE_CELL(i) cells[i]
#define LMP_PREINTEGRATED_LOBE_REMAP(i) remap[i]
#define LMP_PREINTEGRATED_LOBE_SHAPE   shape
#include "preintegrated_lookup.h"
#include "preintegrated_lobe.glsl"
#ifdef SHADE_PREINTEGRATED_BRDF
layout(binding = SHARED_PREINTEGRATED_BRDF_TEXELS) uniform sampler2D brdf_texels;
/* first, for every table, the index of its preintegrated BRDF's numbers, or 0 */
layout(std430, binding = SHARED_PREINTEGRATED_BRDF) readonly buffer brdf_block {
    float brdf_values[];
};
#define LMP_PREINTEGRATED_BRDF_TEXEL(p) textureLod(brdf_texels, (p) / vec2(textureSize(brdf_texels, 0)), 0.0).rgb
#define LMP_PREINTEGRATED_BRDF_VALUE(i) brdf_values[i]
#include "preintegrated_brdf.glsl"
#endif
#endif

#ifdef SHADE_FIELD
#include "field.glsl"
#endif

#include "pixel.glsl"
#include "environment.glsl"
#ifdef TABLE_FULL
#include "table.glsl"
#endif

#if defined(TABLE_FULL) || defined(SHADE_PREINTEGRATED_BRDF)
vec3 shade_by_table(lmp_surface surface, int table) {
#ifdef SHADE_PREINTEGRATED_BRDF
    int first = int(brdf_values[table]);
#ifdef TABLE_FULL
    if (first == 0)
        return shade_table(surface, table);
#endif
    return lmp_shade_preintegrated_brdf(surface, first);
#else
    return shade_table(surface, table);
#endif
}
#endif

layout(local_size_x = SHARED_GROUP, local_size_y = SHARED_GROUP) in;
#ifdef PIXEL_SHEEN
layout(binding = 0, rgba32f) uniform restrict image2D hdr;
#else
layout(binding = 0, rgba32f) uniform writeonly restrict image2D hdr;
#endif

/* Adds a pixel's sheen to what it reflects without it. */
vec3 under_sheen(vec3 reflected) {
#ifdef PIXEL_SHEEN
    vec4 sheen = imageLoad(hdr, ivec2(gl_GlobalInvocationID.xy));
    return reflected * sheen.a + sheen.rgb;
#else
    return reflected;
#endif
}

/* Shades by lobes: of a coated pixel first what is under the coat, then the coat. front is false
 * for what is behind a translucent pixel. */
vec3 shade_by_lobes(pixel p, bool front) {
    lmp_lobes lobes = pixel_lobes(p);
#ifdef PIXEL_LAYERED
    lmp_surface over = lmp_surface(p.surface.position, p.coat_normal, p.surface.view);
    vec3 sum = vec3(0.0);
    for (int layer = 0; layer < (p.coat.weight > 0.0 ? 2 : 1); layer++) {
        if (layer == 1) {
            sum *= 1.0 - lmp_coated(p.coat, over.normal, over.view);
            p.surface = over;
            lobes = lmp_lobes_of(over, p.coat);
        }
        sum += SHADE(p.surface, lobes) + environment_shade(p.surface, lobes) * p.weights.x;
        if (layer == 0 && front)
            sum = under_sheen(sum);
    }
    return sum;
#else
    return SHADE(p.surface, lobes) + environment_shade(p.surface, lobes) * p.weights.x;
#endif
}

vec3 shade_surface(pixel p) {
#if defined(TABLE_FULL) || defined(SHADE_PREINTEGRATED_BRDF)
    if (p.table >= 0) {
        vec3 sum = shade_by_table(p.surface, p.table);
#if TABLE_ENVIRONMENT
        sum += shade_table_environment(p.surface, p.table) * p.weights.x;
#endif
        return sum;
    }
#endif
#ifdef PIXEL_TRANSLUCENT
    vec3 sum = vec3(0.0);
    for (int side = 0; side < (p.through == vec3(0.0) ? 1 : 2); side++) {
        if (side == 1)
            p = pixel_behind(p);
        sum += shade_by_lobes(p, side == 0);
    }
    return sum;
#else
    return shade_by_lobes(p, true);
#endif
}

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, ivec2(size_lights.xy))))
        return;
    int kind = pixel_kind(at);
    vec3 radiance = vec3(0.0);
    if (kind == SHARED_KIND_NONE) {
        radiance = environment_seen(-pixel_view(at));
    } else if (kind == SHARED_KIND_LIGHT) {
        radiance = pixel_light_radiance(at);
    } else {
        radiance = shade_surface(pixel_read(at)) + pixel_emission(at);
    }
    imageStore(hdr, at, vec4(radiance, 1.0));
}
