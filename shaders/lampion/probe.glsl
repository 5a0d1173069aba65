/* SPDX-License-Identifier: MIT */
/* probe.glsl - irradiance from a probe's constants (lampion/probe.h, lmp_probe_make_constants), by
 * itself.
 * GLSL 4.50, GLSL for Vulkan, and GLSL ES from 3.00 on.
 *
 * first, second: `linear` and `quadratic`, the rows of red, green, blue; last as it is. Seven vec4 of
 * a uniform block in the order of lmp_probe_constants. n is unit; the result may ring below 0. */
#ifndef LAMPION_PROBE_GLSL
#define LAMPION_PROBE_GLSL

vec3 lmp_probe_irradiance(vec4 first[3], vec4 second[3], vec4 last, vec3 n) {
    vec4 m = vec4(n, 1.0), q = n.xyzz * n.yzzx;
    return vec3(dot(first[0], m), dot(first[1], m), dot(first[2], m)) +
           vec3(dot(second[0], q), dot(second[1], q), dot(second[2], q)) +
           last.rgb * (n.x * n.x - n.y * n.y);
}

#endif
