/* SPDX-License-Identifier: MIT */
/* Radiance to display: exposure, the filmic curve, the sRGB transfer. The image's rows run from
 * the top; flip = 1 for a window, whose rows run from the bottom. */
#include "shared.h"

layout(binding = SHARED_HDR) uniform sampler2D hdr;
layout(location = 0) uniform float exposure;
layout(location = 1) uniform int flip;
layout(location = 0) out vec4 color;

float transfer(float x) {
    x = clamp(x, 0.0, 1.0);
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1.0 / 2.4) - 0.055;
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    if (flip != 0)
        at.y = int(size_lights.y) - 1 - at.y;
    vec3 x = clamp(texelFetch(hdr, at, 0).rgb * exposure, 0.0, SHARED_TONE_MAX);
    vec3 y = vec3(shared_tone_in(0, x.r, x.g, x.b), shared_tone_in(1, x.r, x.g, x.b),
                  shared_tone_in(2, x.r, x.g, x.b));
    float peak = max(y.r, max(y.g, y.b));
    y = vec3(shared_tone(y.r, peak), shared_tone(y.g, peak), shared_tone(y.b, peak));
    color = vec4(transfer(shared_tone_out(0, y.r, y.g, y.b)),
                 transfer(shared_tone_out(1, y.r, y.g, y.b)),
                 transfer(shared_tone_out(2, y.r, y.g, y.b)), 1.0);
}
