/* SPDX-License-Identifier: MIT */
/* Materials into the G-buffer. SURFACE_MASKED: discard by alpha (a variant, for discarding costs
 * the early depth test): by the cutoff, or of what blends as many samples as let pass what is
 * behind. */
#include "gbuffer.glsl"
#include "shared.h"

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_uv;
layout(location = 2) in vec4 world_tangent;
layout(location = 3) in vec4 world_color;

layout(location = 0) out vec4 out_base_metallic;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_roughness_kind;
layout(location = 3) out vec3 out_emission;
layout(location = 4) out vec2 out_layers;

layout(binding = SHARED_BASE_COLOR) uniform sampler2D base_color_map;
layout(binding = SHARED_METALLIC_ROUGHNESS) uniform sampler2D metallic_roughness_map;
layout(binding = SHARED_NORMAL) uniform sampler2D normal_map;
layout(binding = SHARED_EMISSION) uniform sampler2D emission_map;
layout(binding = SHARED_OCCLUSION) uniform sampler2D occlusion_map;
layout(binding = SHARED_SPECULAR) uniform sampler2D specular_map;

/* Maps by their index in the block. */
#define MAP_OCCLUSION 4
#define MAP_SPECULAR  5

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

/* Of all numbers below `count` another one for each i, by a permutation of its own for each p
 * (Kensler 2013). */
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

/* Of a pixel and triangle the samples' thresholds are spread evenly over 0 … 1, and those of
 * different triangles have nothing to do with each other. */
float blend_threshold() {
    uint p = scrambled(uint(gl_FragCoord.x) * 1664525u + uint(gl_FragCoord.y) * 1013904223u +
                       uint(provoking) * 747796405u + uint(gl_PrimitiveID) * 2891336453u);
    float within = float(scrambled(p + 1u) >> 8u) / 16777216.0;
    return (float(permuted(uint(jitter.z), uint(jitter.w), p)) + within) / jitter.w;
}
#endif

void main() {
    vec4 base = base_color * world_color;
    if (maps.x > 0.0)
        base *= texture(base_color_map, map_uv(SHARED_BASE_COLOR));
#ifdef SURFACE_MASKED
    if (vertex.z > 0.0 ? base.a <= blend_threshold() : base.a < factors.w)
        discard;
#endif

    float metallic = factors.x, roughness = factors.y;
    if (maps.y > 0.0) {
        vec4 texel = texture(metallic_roughness_map, map_uv(SHARED_METALLIC_ROUGHNESS));
        metallic *= texel.b;
        roughness *= texel.g;
    }

    /* Both sides are lit: the back of a sheet has the opposite normal. */
    vec3 n = normalize(world_normal);
    if (maps.z > 0.0) {
        vec3 texel = texture(normal_map, map_uv(SHARED_NORMAL)).xyz * 2.0 - 1.0;
        vec3 t = world_tangent.xyz * inversesqrt(max(dot(world_tangent.xyz, world_tangent.xyz), 1e-20));
        vec3 b = cross(n, t) * world_tangent.w;
        vec3 bent = t * (texel.x * factors.z) + b * (texel.y * factors.z) + n * texel.z;
        n = bent * inversesqrt(max(dot(bent, bent), 1e-20));
    }
    if (!gl_FrontFacing)
        n = -n;

    vec3 emitted = emission.rgb;
    if (maps.w > 0.0)
        emitted *= texture(emission_map, map_uv(SHARED_EMISSION)).rgb;

    vec2 layers = vec2(1.0);
    if (more.x > 0.0)
        layers.x += vertex.y * (texture(occlusion_map, map_uv(MAP_OCCLUSION)).r - 1.0);
    if (more.y > 0.0)
        layers.y = texture(specular_map, map_uv(MAP_SPECULAR)).a;

    out_base_metallic = vec4(gbuffer_encode_color(base.rgb), metallic);
    out_normal = gbuffer_encode_normal(n);
    out_roughness_kind = vec2(roughness, gbuffer_encode_kind(int(emission.w)));
    out_emission = emitted;
    out_layers = layers;
}
