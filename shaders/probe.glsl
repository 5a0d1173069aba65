/* SPDX-License-Identifier: MIT */
/* probe.glsl - irradiance from a probe's constants (lampion/probe.h, lmp_probe_constants_of), by
 * itself: GLSL 4.50 and GLSL ES 3.00.
 *
 * linear, quadratic: the rows of red, green, blue; last as it is. Seven vec4 of a uniform block in
 * the order of lmp_probe_constants. n is unit; the result may ring below 0. */
#ifndef LAMPION_PROBE_GLSL
#define LAMPION_PROBE_GLSL

vec3 lmp_probe_irradiance(vec4 linear[3], vec4 quadratic[3], vec4 last, vec3 n) {
    vec4 first = vec4(n, 1.0), second = n.xyzz * n.yzzx;
    return vec3(dot(linear[0], first), dot(linear[1], first), dot(linear[2], first)) +
           vec3(dot(quadratic[0], second), dot(quadratic[1], second), dot(quadratic[2], second)) +
           last.rgb * (n.x * n.x - n.y * n.y);
}

#endif
