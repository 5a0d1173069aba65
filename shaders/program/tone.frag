/* SPDX-License-Identifier: MIT */
/* Converts radiance for display: exposure, the tone curve TONE of tone.h, the sRGB transfer. The
 * image's rows run from the top; flip = 1 for a window, whose rows run from the bottom. */
#include "shared.h"
#include "tone.h"

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
    color = vec4(transfer(TONE(0, x.r, x.g, x.b)), transfer(TONE(1, x.r, x.g, x.b)),
                 transfer(TONE(2, x.r, x.g, x.b)), 1.0);
}
