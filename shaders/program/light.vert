/* SPDX-License-Identifier: MIT */
/* Draws one cube per light by its far faces, so that it also covers the view from inside; for
 * area.vert (LIGHT_AREAS), one around each area. */
#include "shared.h"

layout(location = 0) out vec3 world_position;
layout(location = 1) flat out int light;

void main() {
    /* A strip of 14 corners runs around the six faces. */
    int corner = gl_VertexID;
    vec3 unit = vec3((0x287a >> corner) & 1, (0x02af >> corner) & 1, (0x31e3 >> corner) & 1);
#ifdef LIGHT_AREAS
    vec4 sphere = vec4(areas_texel(gl_InstanceID, 0).xyz, areas_texel(gl_InstanceID, 1).w);
    bool hidden = areas_texel(gl_InstanceID, SHARED_AREA_NUMBER).w < 0.0;
#else
    vec4 sphere = lights[gl_InstanceID].sphere;
    bool hidden = lights[gl_InstanceID].radiance.w > 0.0;
#endif
    world_position = sphere.xyz + sphere.w * (unit * 2.0 - 1.0);
    light = gl_InstanceID;
    gl_Position = hidden ? vec4(0.0, 0.0, 0.0, -1.0) : clip_from_world * vec4(world_position, 1.0);
    if (forward.w > 0.0)
        gl_Position.z = 0.5; /* fragments write their own depth, however far */
}
