/* SPDX-License-Identifier: MIT */
/* Draws the exact sphere of a light or, for area.frag (LIGHT_AREAS), an area, by intersecting it with
 * the pixel's ray. */
#include "camera.glsl"
#include "gbuffer.glsl"
#include "shared.h"

layout(location = 0) in vec3 world_position;
layout(location = 1) flat in int light;

layout(location = 0) out vec4 out_base_metallic;
layout(location = 1) out vec2 out_normal;
layout(location = 2) out vec2 out_roughness_kind;
layout(location = 3) out vec3 out_emission;
layout(location = 4) out vec2 out_weights;

/* Returns the distance to a light whose middle is at `center`, or one below 0 for a miss. */
float light_hit(vec3 center, vec3 ray) {
#ifdef LIGHT_AREAS
    return area_hit(light, center, ray);
#else
    /* the distance of the ray's nearest point to the center, by a cross product, which is exact far
     * away */
    float along = dot(ray, center), radius = lights[light].sphere.w;
    vec3 miss = center - ray * along;
    float half_chord2 = radius * radius - dot(miss, miss);
    if (half_chord2 < 0.0)
        return -1.0;
    float half_chord = sqrt(half_chord2);
    return along - half_chord > 0.0 ? along - half_chord : along + half_chord;
#endif
}

void main() {
#ifdef LIGHT_AREAS
    vec3 middle = areas_texel(light, 0).xyz;
    int number = int(areas_texel(light, SHARED_AREA_NUMBER).w);
#else
    vec3 middle = lights[light].sphere.xyz;
    int number = light;
#endif
    vec3 way = world_position - eye.xyz;
    vec3 ray = forward.w == 0.0 ? normalize(way) : forward.xyz;
    vec3 center = middle - eye.xyz - (way - ray * dot(way, ray)) * forward.w;
    float hit = light_hit(center, ray);
    float depth = camera_depth(hit * dot(ray, forward.xyz));
    if (hit <= 0.0 || depth > 1.0 || depth <= 0.0)
        discard;
    gl_FragDepth = depth;
    out_base_metallic = vec4(0.0);
    out_normal = vec2(gbuffer_encode_light(number), 0.0);
    out_roughness_kind = vec2(0.0, gbuffer_encode_kind(SHARED_KIND_LIGHT));
    out_emission = vec3(0.0);
    out_weights = vec2(0.0);
}
