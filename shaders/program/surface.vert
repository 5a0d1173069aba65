/* SPDX-License-Identifier: MIT */
#include "shared.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv; /* two sets of texture coordinates */
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 color;
#ifndef GL_ES /* the browser's meshes are in world coordinates */
layout(location = 5) in vec4 row_x; /* rows of the instance's matrix into the world */
layout(location = 6) in vec4 row_y;
layout(location = 7) in vec4 row_z;
layout(location = 8) in uint instance; /* index among the mesh's instances, + SHARED_INSTANCE_MOVES */
#endif

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec4 world_uv;
layout(location = 2) out vec4 world_tangent;
layout(location = 3) out vec4 world_color;
#ifdef SURFACE_MASKED
layout(location = 4) flat out int provoking;
#endif

void main() {
    vec3 world_position = position;
    world_normal = normal;
    world_tangent = tangent;
#ifndef GL_ES
    if ((instance & SHARED_INSTANCE_MOVES) != 0u) {
        vec4 p = vec4(position, 1.0);
        vec3 x = row_x.xyz, y = row_y.xyz, z = row_z.xyz, t = tangent.xyz;
        vec3 normal_x = cross(y, z), normal_y = cross(z, x), normal_z = cross(x, y);
        float side = dot(x, normal_x) < 0.0 ? -1.0 : 1.0;
        vec3 n = vec3(dot(normal_x, normal), dot(normal_y, normal), dot(normal_z, normal));
        world_position = vec3(dot(row_x, p), dot(row_y, p), dot(row_z, p));
        world_normal = normalize(side * n);
        world_tangent = vec4(normalize(vec3(dot(x, t), dot(y, t), dot(z, t))), side * tangent.w);
    }
#endif
    gl_Position = clip_from_world * vec4(world_position, 1.0);
#ifdef SURFACE_MASKED
    provoking = gl_VertexID;
#ifndef GL_ES
    provoking += int(instance & ~SHARED_INSTANCE_MOVES) * 0x2c1b3c6d;
#endif
#endif
    world_uv = uv;
    world_color = color;
}
