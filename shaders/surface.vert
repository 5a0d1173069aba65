/* SPDX-License-Identifier: MIT */
#include "shared.h"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 uv; /* two sets */
layout(location = 3) in vec4 tangent;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 world_normal;
layout(location = 1) out vec4 world_uv;
layout(location = 2) out vec4 world_tangent;
layout(location = 3) out vec4 world_color;
#ifdef SURFACE_MASKED
layout(location = 4) flat out int provoking;
#endif

void main() {
    gl_Position = clip_from_world * vec4(position, 1.0);
#ifdef SURFACE_MASKED
    provoking = gl_VertexID;
#endif
    world_normal = normal;
    world_uv = uv;
    world_tangent = tangent;
    world_color = color;
}
