/* SPDX-License-Identifier: MIT */
/* splat.frag - a splat's radiance and opacity, where no surface of the G-buffer is nearer; depth is
 * reversed. */
layout(location = 0) in vec2 deviations;
layout(location = 1) in vec3 radiance;
uniform sampler2D depths;
out vec4 color;

void main() {
    float square = dot(deviations, deviations);
    if (square > 9.0 || gl_FragCoord.z < texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r)
        discard;
    color = vec4(radiance, 0.95 * exp(-0.5 * square));
}
