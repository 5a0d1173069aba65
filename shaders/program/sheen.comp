/* SPDX-License-Identifier: MIT */
/* sheen.comp - the sheen of cloth, lmp_sheen_layer of the library, before what is under it is shaded:
 * one thread per pixel writes to the HDR target what the sheen reflects and, in alpha, the fraction
 * of light that the rest keeps. LMP_BANDS are those of the tables of white sheen. SHADE_FIELD: of
 * a field, too, which is read. */
#define PIXEL_LAYERED
#define TABLE_FULL 0
#define TABLE_PAIR
#include "gbuffer.glsl"
#include "shared.h"

#include "light.glsl"
#include "material.glsl"
#include "lampion.glsl"
#include "coefficients.glsl"
#ifdef SHADE_FIELD
#include "field.glsl"
#endif
#include "pixel.glsl"
#include "environment.glsl"
#include "table.glsl"

/* Finds the rows of the two tables between whose roughnesses the sheen's lies. */
void sheen_rows(float roughness, float cosine, out ivec4 first, out vec4 weight) {
    float last = float(SHARED_SHEEN_TABLES - 1), least = SHARED_SHEEN_ROUGHNESS_MIN;
    float held = clamp((roughness - least) / (1.0 - least) * last, 0.0, last);
    int below = min(int(held), SHARED_SHEEN_TABLES - 2);
    ivec4 above_first;
    vec4 above_weight;
    table_rows(below, cosine, 0.0, first, weight);
    table_rows(below + 1, cosine, 0.0, above_first, above_weight);
    float above = held - float(below);
    first.zw = above_first.xy;
    weight = vec4(weight.xy * (1.0 - above), above_weight.xy * above);
}

vec4 shade_sheen(pixel p) {
#ifdef SHADE_FIELD
    field_find(p.surface.position);
#endif
    table_frame f = table_frame_of(p.surface);
    ivec4 first;
    vec4 weight;
    sheen_rows(p.sheen.a, dot(p.surface.view, f.n), first, weight);
    vec3 white = shade_rows(p.surface, f, first, weight);
#if TABLE_ENVIRONMENT
    white += shade_rows_environment(f, first, weight) * p.weights.x;
#endif
    /* What white sheen reflects of a uniform sky; coefficient 0 holds the mean over all directions.
     */
    float albedo = TABLE_AT(first, weight, 0).r * sqrt(4.0 * LMP_PI);
    float most = max(p.sheen.r, max(p.sheen.g, p.sheen.b));
    return vec4(p.sheen.rgb * white, max(1.0 - most * albedo, 0.0));
}

layout(local_size_x = SHARED_GROUP, local_size_y = SHARED_GROUP) in;
layout(binding = 0, rgba32f) uniform writeonly restrict image2D hdr;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(at, ivec2(size_lights.xy))))
        return;
    vec4 shaded = vec4(0.0, 0.0, 0.0, 1.0);
    if (pixel_kind(at) >= SHARED_KIND_SURFACE) {
        pixel p = pixel_read(at);
        if (any(greaterThan(p.sheen.rgb, vec3(0.0))))
            shaded = shade_sheen(p);
    }
    imageStore(hdr, at, shaded);
}
