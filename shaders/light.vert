/* SPDX-License-Identifier: MIT */
/* One cube a light, drawn by its far faces: it also covers the view from inside. */
#include "shared.h"

layout(location = 0) out vec3 world_position;
layout(location = 1) flat out int light;

void main() {
    /* a strip of 14 corners runs around the six faces */
    int corner = gl_VertexID;
    vec3 unit = vec3((0x287a >> corner) & 1, (0x02af >> corner) & 1, (0x31e3 >> corner) & 1);
    vec4 sphere = lights[gl_InstanceID].sphere;
    world_position = sphere.xyz + sphere.w * (unit * 2.0 - 1.0);
    light = gl_InstanceID;
    bool hidden = lights[gl_InstanceID].radiance.w > 0.0;
    gl_Position = hidden ? vec4(0.0, 0.0, 0.0, -1.0) : clip_from_world * vec4(world_position, 1.0);
    if (forward.w > 0.0)
        gl_Position.z = 0.5; /* the fragments tell their own depth, however far */
}
