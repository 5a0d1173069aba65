/* SPDX-License-Identifier: MIT */
/* Copies the surfaces that shade.comp shades, for the same evaluation elsewhere. */
#include "gbuffer.glsl"
#include "shared.h"

#include "material.glsl"
#include "lampion.glsl"

#include "pixel.glsl"
#include "environment.glsl"

layout(local_size_x = SHARED_GROUP, local_size_y = SHARED_GROUP) in;
layout(std430, binding = 0) writeonly restrict buffer pixels_block {
    shared_pixel pixels[];
};
layout(location = 0) uniform int first_row;

void main() {
    ivec2 at = ivec2(gl_GlobalInvocationID.xy) + ivec2(0, first_row);
    if (any(greaterThanEqual(at, ivec2(size_lights.xy))))
        return;
    int kind = pixel_kind(at);
    pixel p = pixel_read(at);
    shared_pixel o;
    o.position_kind = vec4(p.surface.position, float(kind));
    o.normal_metallic = vec4(p.surface.normal, p.material.metallic);
    o.view_roughness = vec4(p.surface.view, p.material.roughness);
    o.base_color = vec4(p.material.base_color, 0.0);
    o.emission = vec4(kind == SHARED_KIND_LIGHT     ? pixel_light_radiance(at)
                      : kind != SHARED_KIND_NONE    ? pixel_emission(at)
                                                    : environment_seen(-p.surface.view),
                      0.0);
    o.weights = vec4(p.weights, 0.0, 0.0);
    o.coat = vec4(p.coat_normal, p.coat.weight);
    o.tint = vec4(p.tint, p.coat.roughness);
    o.sheen = p.sheen;
    pixels[(at.y - first_row) * int(size_lights.x) + at.x] = o;
}
