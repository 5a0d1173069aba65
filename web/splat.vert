/* SPDX-License-Identifier: MIT */
/* splat.vert - a flat Gaussian splat (Huang et al. 2024) as a quad of three standard deviations. */
#include "shared.h"

layout(location = 0) in vec3 center;
layout(location = 1) in vec3 along;
layout(location = 2) in vec3 across;
layout(location = 3) in vec3 lit;

layout(location = 0) out vec2 deviations;
layout(location = 1) out vec3 radiance;

void main() {
    deviations = 3.0 * (2.0 * vec2(gl_VertexID & 1, gl_VertexID >> 1) - 1.0);
    radiance = lit;
    gl_Position = clip_from_world * vec4(center + deviations.x * along + deviations.y * across, 1.0);
}
