/* SPDX-License-Identifier: MIT */
/* Writes materials to the G-buffer. SURFACE_PLAIN: materials without maps and colors of vertices,
 * for which only the normal is interpolated. SURFACE_MASKED: discards by alpha (a variant, because
 * discarding costs the early depth test): by the cutoff or, for materials that blend, as many
 * samples as let pass what is behind. SURFACE_LAYERED: materials with a coat, a sheen or a tint. */
#include "gbuffer.glsl"
#include "shared.h"
#ifdef SURFACE_LAYERED
#include "camera.glsl"
#include "coat.glsl"
#endif

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_uv;
layout(location = 2) in vec4 world_tangent;
layout(location = 3) in vec4 world_color;

layout(location = 0) out vec4 out_base_metallic;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_roughness_kind;
layout(location = 3) out vec4 out_emission;
layout(location = 4) out vec2 out_weights;
#ifdef SURFACE_LAYERED
layout(location = 5) out vec4 out_coat;
layout(location = 6) out vec4 out_tint;
layout(location = 7) out vec4 out_sheen;
#endif

layout(binding = SHARED_BASE_COLOR) uniform sampler2D base_color_map;
layout(binding = SHARED_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_map;
layout(binding = SHARED_NORMAL) uniform sampler2D normal_map;
layout(binding = SHARED_EMISSION) uniform sampler2D emission_map;
layout(binding = SHARED_OCCLUSION) uniform sampler2D occlusion_map;
layout(binding = SHARED_OCCLUSION + 1) uniform sampler2D specular_map;
#ifndef SURFACE_PLAIN
layout(binding = SHARED_OCCLUSION + 8) uniform sampler2D through_map;
layout(binding = SHARED_OCCLUSION + 9) uniform sampler2D through_color_map;
#endif
#ifdef SURFACE_LAYERED
layout(binding = SHARED_OCCLUSION + 2) uniform sampler2D specular_color_map;
layout(binding = SHARED_OCCLUSION + 3) uniform sampler2D coat_map;
layout(binding = SHARED_OCCLUSION + 4) uniform sampler2D coat_roughness_map;
layout(binding = SHARED_OCCLUSION + 5) uniform sampler2D coat_normal_map;
layout(binding = SHARED_OCCLUSION + 6) uniform sampler2D sheen_color_map;
layout(binding = SHARED_OCCLUSION + 7) uniform sampler2D sheen_roughness_map;
#endif

/* Whether a flag of the material is set. */
#ifdef SURFACE_PLAIN
#define IS_SET(flag) false
#else
#define IS_SET(flag) ((flag) > 0.0)
#endif

vec2 map_uv(int map) {
    vec2 uv = offset[map].z > 0.0 ? world_uv.zw : world_uv.xy;
    return vec2(dot(matrix[map].xy, uv), dot(matrix[map].zw, uv)) + offset[map].xy;
}

#ifdef SURFACE_MASKED
layout(location = 4) flat in int provoking;

uint scrambled(uint h) {
    h = ((h >> ((h >> 28u) + 4u)) ^ h) * 277803737u;
    return h ^ h >> 22u;
}

/* Permutes the numbers below `count`: returns another one for each i, by a permutation of its own
 * for each p (Kensler 2013). */
uint permuted(uint i, uint count, uint p) {
    uint mask = count - 1u;
    for (uint shift = 1u; shift < 32u; shift *= 2u)
        mask |= mask >> shift;
    do {
        i = (i ^ p) * 0xe170893du;
        i = (i ^ p >> 16u ^ (i & mask) >> 4u ^ p >> 8u) * 0x0929eb3fu;
        i = (i ^ p >> 23u ^ (i & mask) >> 1u) * (1u | p >> 27u) * 0x6935fa69u;
        i = (i ^ (i & mask) >> 11u) * 0x74dcb303u;
        i = (i ^ (i & mask) >> 2u) * 0x9e501cc3u;
        i = (i ^ (i & mask) >> 2u) * 0xc860a3dfu;
        i &= mask;
        i ^= i >> 5u;
    } while (i >= count);
    return (i + p) % count;
}

/* Returns the threshold of a sample. Within a pixel and triangle thresholds are spread evenly over
 * 0 … 1; those of different triangles are independent. */
float blend_threshold() {
    uint p = scrambled(uint(gl_FragCoord.x) * 1664525u + uint(gl_FragCoord.y) * 1013904223u +
                       uint(provoking) * 747796405u + uint(gl_PrimitiveID) * 2891336453u);
    float within = float(scrambled(p + 1u) >> 8u) / 16777216.0;
    return (float(permuted(uint(jitter.z), uint(jitter.w), p)) + within) / jitter.w;
}
#endif

bool has_map(int map) {
    return IS_SET(more[map / 4 - 1][map % 4]);
}

/* Bends n by a texel of a normal map. */
vec3 bend(vec3 n, vec3 texel, float scale) {
    vec3 along = texel * 2.0 - 1.0;
    vec3 t = world_tangent.xyz * inversesqrt(max(dot(world_tangent.xyz, world_tangent.xyz), 1e-20));
    vec3 b = cross(n, t) * world_tangent.w;
    vec3 bent = t * (along.x * scale) + b * (along.y * scale) + n * along.z;
    return bent * inversesqrt(max(dot(bent, bent), 1e-20));
}

/* Returns the color of light from behind that passes through, which is taken from the base color
 * (KHR_materials_diffuse_transmission); for a leaf it is a fraction of the base color, which loses
 * nothing. */
vec3 let_through(float metallic, inout vec3 base) {
#ifdef SURFACE_PLAIN
    return vec3(0.0);
#else
    float part = transmission.w * (1.0 - metallic);
    vec3 color = transmission.rgb;
    if (transmission.w < 0.0)
        return color * base * (1.0 - metallic);
    if (part == 0.0)
        return vec3(0.0);
    if (has_map(SHARED_MAP_THROUGH))
        part *= texture(through_map, map_uv(SHARED_MAP_THROUGH)).a;
    if (has_map(SHARED_MAP_THROUGH_COLOR))
        color *= texture(through_color_map, map_uv(SHARED_MAP_THROUGH_COLOR)).rgb;
    base *= 1.0 - part;
    return color * part;
#endif
}

#ifdef SURFACE_LAYERED
/* Writes the layers; returns the fraction of what is under the coat that is seen through it. */
float write_layers() {
    vec3 n = normalize(world_normal);
    if (has_map(SHARED_MAP_COAT_NORMAL))
        n = bend(n, texture(coat_normal_map, map_uv(SHARED_MAP_COAT_NORMAL)).xyz, coat.z);
    vec2 over = coat.xy;
    if (has_map(SHARED_MAP_COAT))
        over.x *= texture(coat_map, map_uv(SHARED_MAP_COAT)).r;
    if (has_map(SHARED_MAP_COAT_ROUGHNESS))
        over.y *= texture(coat_roughness_map, map_uv(SHARED_MAP_COAT_ROUGHNESS)).g;
    vec3 tint = vec3(1.0);
    if (has_map(SHARED_MAP_SPECULAR_COLOR))
        tint = texture(specular_color_map, map_uv(SHARED_MAP_SPECULAR_COLOR)).rgb;
    vec4 mapped_sheen = sheen;
    if (has_map(SHARED_MAP_SHEEN_COLOR))
        mapped_sheen.rgb *= texture(sheen_color_map, map_uv(SHARED_MAP_SHEEN_COLOR)).rgb;
    if (has_map(SHARED_MAP_SHEEN_ROUGH))
        mapped_sheen.a *= texture(sheen_roughness_map, map_uv(SHARED_MAP_SHEEN_ROUGH)).a;
    vec2 at = gl_FragCoord.xy / size_lights.xy * 2.0 - 1.0 + jitter.xy;
    vec3 away = normalize(camera_ray_through(at).along);
    out_coat = vec4(gbuffer_encode_normal(gl_FrontFacing ? n : -n), over);
    out_tint = vec4(gbuffer_encode_color(tint), 0.0);
    out_sheen = vec4(gbuffer_encode_color(mapped_sheen.rgb), mapped_sheen.a);
    return 1.0 - lmp_coated(lmp_coat(over.x, over.y), n, away);
}
#endif

void main() {
    vec4 base = base_color;
    if (IS_SET(vertex.x))
        base *= world_color;
    if (IS_SET(maps.x))
        base *= texture(base_color_map, map_uv(SHARED_BASE_COLOR));
#ifdef SURFACE_MASKED
    if (vertex.z > 0.0 ? base.a <= blend_threshold() : base.a < factors.w)
        discard;
#endif

    float metallic = factors.x, roughness = factors.y;
    if (IS_SET(maps.y)) {
        vec4 texel = texture(metallic_roughness_map, map_uv(SHARED_METALLIC_ROUGHNESS));
        metallic *= texel.b;
        roughness *= texel.g;
    }

    /* Both sides are lit: on the back of a sheet the normal is reversed. */
    vec3 n = normalize(world_normal);
    if (IS_SET(maps.z))
        n = bend(n, texture(normal_map, map_uv(SHARED_NORMAL)).xyz, factors.z);
    if (!gl_FrontFacing)
        n = -n;

    vec3 emitted = emission.rgb;
    if (IS_SET(maps.w))
        emitted *= texture(emission_map, map_uv(SHARED_EMISSION)).rgb;
    if (IS_SET(vertex.w))
        emitted *= world_color.rgb;

    vec2 weights = vec2(1.0);
    if (has_map(SHARED_MAP_OCCLUSION))
        weights.x += vertex.y * (texture(occlusion_map, map_uv(SHARED_MAP_OCCLUSION)).r - 1.0);
    if (has_map(SHARED_MAP_SPECULAR))
        weights.y = texture(specular_map, map_uv(SHARED_MAP_SPECULAR)).a;

    vec3 through = let_through(metallic, base.rgb);
#ifdef SURFACE_LAYERED
    float seen = write_layers();
    emitted *= seen;
    through *= seen;
#endif
    out_base_metallic = vec4(gbuffer_encode_color(base.rgb), metallic);
    out_normal = gbuffer_encode_normal(n);
    out_roughness_kind = vec2(roughness, gbuffer_encode_kind(int(emission.w)));
    out_emission = vec4(emitted, gbuffer_pack_color(through));
    out_weights = weights;
}
