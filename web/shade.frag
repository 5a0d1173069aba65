/* SPDX-License-Identifier: MIT */
/* shade.frag - shade.comp for WebGL 2: the radiance of a pixel of the G-buffer, by SHADE. A page has
 * no storage blocks: tables are textures. */
#include "gbuffer.glsl"
#include "shared.h"
#include "camera.glsl"
#include "light.glsl"

uniform sampler2D base_metallic, normals, roughness_kind, emissions, weights, depths;
uniform vec2 pixels; /* pixels of the G-buffer per pixel of the target */
out vec4 color;

#ifdef SHADE_DRAFT
#include "draft.glsl"
#else
uniform sampler2D material_constants; /* F0 and F90 of the materials' dielectrics */
uniform sampler2D ggx_texels;
#define LMP_GGX_TEXEL(i) texelFetch(ggx_texels, ivec2((i) % 32, (i) / 32), 0)
#include "ggx.glsl"
#ifdef SHADE_AREAS
#include "texels.glsl"
#include "areas.glsl"
#endif
#include "lampion.glsl"
#ifdef SHADE_COEFFICIENTS
#include "coefficients.glsl"
#endif
#ifdef SHADE_AREAS
#include "area.glsl"
#endif
#ifdef SHADE_PREINTEGRATED
uniform sampler2D lobe_pairs, lobe_cells, lobe_remap;
uniform vec4 lobe_shape;
#define LMP_PREINTEGRATED_LOBE_PAIR(p)  textureLod(lobe_pairs, (p) * lobe_shape.zw, 0.0).rg
#define LMP_PREINTEGRATED_LOBE_CELL(i)  texelFetch(lobe_cells, ivec2(i, 0), 0)
#define LMP_PREINTEGRATED_LOBE_REMAP(i) texelFetch(lobe_remap, ivec2(i, 0), 0).r
#define LMP_PREINTEGRATED_LOBE_SHAPE    lobe_shape
#include "preintegrated_lookup.h"
#include "preintegrated_lobe.glsl"
#endif
#ifdef SHADE_PROBES
#include "volume.glsl"
/* The diffuse lobe alone: three bands hold irradiance, but nothing that glosses. */
vec3 shade_probes(lmp_surface surface, lmp_lobes lobes) {
    return lobes.diffuse * lampionVolumeIrradiance(surface.position, surface.normal) / LMP_PI;
}
#endif

vec3 shade_surface(ivec2 at, int kind) {
    camera_ray ray = camera_ray_through((vec2(at) + 0.5) / size_lights.xy * 2.0 - 1.0);
    vec4 base = texelFetch(base_metallic, at, 0);
    vec4 constants = texelFetch(material_constants, ivec2(kind - SHARED_KIND_SURFACE, 0), 0);
    float weight = constants.a * texelFetch(weights, at, 0).g;
    lmp_surface surface;
    surface.position = ray.from + ray.along * camera_distance(texelFetch(depths, at, 0).r);
    surface.normal = gbuffer_decode_normal(texelFetch(normals, at, 0).rg);
    surface.view = -normalize(ray.along);
    lmp_metallic_roughness material = lmp_metallic_roughness(
        gbuffer_decode_color(base.rgb), base.a, texelFetch(roughness_kind, at, 0).r);
    lmp_lobes lobes =
        lmp_lobes_of(surface, material, lmp_dielectric(min(constants.rgb, 1.0) * weight, weight));
    return SHADE(surface, lobes) + texelFetch(emissions, at, 0).rgb;
}
#endif

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy * pixels);
    int kind = gbuffer_decode_kind(texelFetch(roughness_kind, at, 0).g);
    vec3 radiance = vec3(0.0);
    if (kind == SHARED_KIND_LIGHT)
        radiance = lights[gbuffer_decode_light(texelFetch(normals, at, 0).r)].radiance.rgb;
    else if (kind != SHARED_KIND_NONE)
        radiance = shade_surface(at, kind);
    color = vec4(radiance, 1.0);
}
