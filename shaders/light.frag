/* SPDX-License-Identifier: MIT */
/* The exact sphere of a light, by intersection with the pixel's ray. */
#include "camera.glsl"
#include "gbuffer.glsl"
#include "shared.h"

layout(location = 0) in vec3 world_position;
layout(location = 1) flat in int light;

layout(location = 0) out vec4 out_base_metallic;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_roughness_kind;
layout(location = 3) out vec3 out_emission;
layout(location = 4) out vec2 out_layers;

void main() {
    vec4 sphere = lights[light].sphere;
    vec3 way = world_position - eye.xyz;
    vec3 ray = forward.w == 0.0 ? normalize(way) : forward.xyz;
    vec3 center = sphere.xyz - eye.xyz - (way - ray * dot(way, ray)) * forward.w;
    /* the ray's nearest point to the center; its distance by a cross product, exact far away */
    float along = dot(ray, center);
    vec3 miss = center - ray * along;
    float half_chord2 = sphere.w * sphere.w - dot(miss, miss);
    if (half_chord2 < 0.0)
        discard;
    float half_chord = sqrt(half_chord2);
    float hit = along - half_chord > 0.0 ? along - half_chord : along + half_chord;
    float depth = camera_depth(hit * dot(ray, forward.xyz));
    if (hit <= 0.0 || depth > 1.0 || depth <= 0.0)
        discard;
    gl_FragDepth = depth;
    out_base_metallic = vec4(0.0);
    out_normal = vec2(gbuffer_encode_light(light), 0.0);
    out_roughness_kind = vec2(0.0, gbuffer_encode_kind(SHARED_KIND_LIGHT));
    out_emission = vec3(0.0);
    out_layers = vec2(0.0);
}
