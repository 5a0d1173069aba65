/* SPDX-License-Identifier: MIT */
#include "shared.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec4 tangent;

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec2 world_uv;
layout(location = 2) out vec4 world_tangent;

void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
    world_normal = normal;
    world_uv = uv;
    world_tangent = tangent;
}
