/* SPDX-License-Identifier: MIT */
/* pixel.glsl - a pixel of the G-buffer as a surface and a material of lampion.glsl. */
#include "camera.glsl"
#include "coat.glsl"

layout(binding = SHARED_BASE_COLOR) uniform sampler2D base_metallic_texture;
layout(binding = SHARED_METALLIC_ROUGHNESS) uniform sampler2D roughness_kind_texture;
layout(binding = SHARED_NORMAL) uniform sampler2D normal_texture;
layout(binding = SHARED_EMISSION) uniform sampler2D emission_texture;
layout(binding = SHARED_DEPTH) uniform sampler2D depth_texture;
layout(binding = SHARED_WEIGHTS) uniform sampler2D weights_texture;
#ifdef PIXEL_LAYERED
layout(binding = SHARED_COAT) uniform sampler2D coat_texture;
layout(binding = SHARED_TINT) uniform sampler2D tint_texture;
layout(binding = SHARED_SHEEN) uniform sampler2D sheen_texture;
#endif
layout(std430, binding = SHARED_MATERIAL_CONSTANTS) readonly restrict buffer material_constants_block {
    shared_material_constants material_constants[];
};

struct pixel {
    lmp_surface surface;
    lmp_metallic_roughness material;
    lmp_dielectric dielectric;
    vec2 weights;
    int table; /* a table to shade by instead of the material, or -1 */
    lmp_coat coat;
    vec3 coat_normal, tint;
    vec4 sheen; /* color, roughness */
    vec3 through; /* the color of light from behind that passes through */
};

int pixel_kind(ivec2 at) {
    return gbuffer_decode_kind(texelFetch(roughness_kind_texture, at, 0).g);
}

vec3 pixel_light_radiance(ivec2 at) {
    return lights[gbuffer_decode_light(texelFetch(normal_texture, at, 0).r)].radiance.rgb;
}

vec3 pixel_emission(ivec2 at) {
    return texelFetch(emission_texture, at, 0).rgb;
}

camera_ray pixel_ray(ivec2 at) {
    return camera_ray_through((vec2(at) + 0.5) / size_lights.xy * 2.0 - 1.0 + jitter.xy);
}

vec3 pixel_view(ivec2 at) {
    return -normalize(pixel_ray(at).along);
}

/* Reads a pixel; where there is no surface its values mean nothing. */
pixel pixel_read(ivec2 at) {
    camera_ray ray = pixel_ray(at);
    vec4 base_metallic = texelFetch(base_metallic_texture, at, 0);
    pixel p;
    p.surface.position = ray.from + ray.along * camera_distance(texelFetch(depth_texture, at, 0).r);
    p.surface.normal = gbuffer_decode_normal(texelFetch(normal_texture, at, 0).rg);
    p.surface.view = -normalize(ray.along);
    vec2 roughness_kind = texelFetch(roughness_kind_texture, at, 0).rg;
    p.material = lmp_metallic_roughness(gbuffer_decode_color(base_metallic.rgb), base_metallic.a,
                                        roughness_kind.r);
    int number = gbuffer_decode_kind(roughness_kind.g) - SHARED_KIND_SURFACE;
    shared_material_constants constants = material_constants[max(number, 0)];
    p.weights = texelFetch(weights_texture, at, 0).rg;
    p.coat = lmp_coat(0.0, 0.0);
    p.coat_normal = p.surface.normal;
    p.tint = vec3(1.0);
    p.sheen = vec4(0.0);
    p.through = vec3(0.0);
#ifdef PIXEL_TRANSLUCENT
    if (constants.table.x < 0.0)
        p.through = gbuffer_unpack_color(texelFetch(emission_texture, at, 0).a);
#endif
#ifdef PIXEL_LAYERED
    if (constants.table.y > 0.0 && constants.table.x < 0.0) {
        vec4 coat = texelFetch(coat_texture, at, 0);
        p.coat = lmp_coat(coat.z, coat.w);
        p.coat_normal = gbuffer_decode_normal(coat.xy);
        p.tint = gbuffer_decode_color(texelFetch(tint_texture, at, 0).rgb);
        vec4 sheen = texelFetch(sheen_texture, at, 0);
        p.sheen = vec4(gbuffer_decode_color(sheen.rgb), sheen.a);
    }
#endif
    float weight = constants.dielectric.a * p.weights.y;
    p.dielectric = lmp_dielectric(min(constants.dielectric.rgb * p.tint, 1.0) * weight, weight);
    p.table = int(constants.table.x);
    return p;
}

/* Returns the surface by which a pixel lets light from behind through: a matte surface with the
 * opposite normal. */
pixel pixel_behind(pixel p) {
    p.surface.normal = -p.surface.normal;
    p.surface.view = -p.surface.view;
    p.material = lmp_metallic_roughness(p.through, 0.0, 1.0);
    p.dielectric = lmp_dielectric(vec3(0.0), 0.0);
    p.coat = lmp_coat(0.0, 0.0);
    return p;
}

lmp_lobes pixel_lobes(pixel p) {
    return lmp_lobes_of(p.surface, p.material, p.dielectric);
}
