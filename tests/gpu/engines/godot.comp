#version 450
/* SPDX-License-Identifier: MIT */
/* lampion_probe.gdshaderinc, whose language is that of GLSL here, as a compute shader: two colors a surface, of
 * three bands and of two. */
#extension GL_GOOGLE_include_directive : require
layout(local_size_x = SURFACES) in;
layout(std430, binding = 0) readonly buffer given_block { vec4 given[]; };
layout(std430, binding = 1) buffer values_block { float values[]; };
#include "lampion_probe.gdshaderinc"

void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 three[7], two[3];
    for (int k = 0; k < 7; k++)
        three[k] = given[PROBE + k];
    for (int k = 0; k < 3; k++)
        two[k] = given[PROBE + 7 + k];
    vec3 n = given[2 * LIGHTS + 3 * i + 1].xyz, first = lmp_probe_l2(three, n), second = lmp_probe_l1(two, n);
    for (int c = 0; c < 3; c++) {
        values[6 * i + c] = first[c];
        values[6 * i + 3 + c] = second[c];
    }
}
