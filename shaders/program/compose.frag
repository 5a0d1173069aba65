/* SPDX-License-Identifier: MIT */
/* Shows one or two images in a window. Their rows run from the top; flip = 1 for a window. */
layout(binding = 0) uniform sampler2D first;
layout(binding = 1) uniform sampler2D second;
layout(location = 0) uniform vec2 size;
layout(location = 1) uniform int flip;
layout(location = 2) uniform int split; /* 0 shows the first, 1 both, divided, 2 their difference */
layout(location = 3) uniform vec2 divider; /* middle and width of the divider, in pixels */
layout(location = 4) uniform float gain;
layout(location = 0) out vec4 color;

/* Reads a texel, exact where the sizes agree. */
vec3 pick(sampler2D side, vec2 at) {
    return textureSize(side, 0) == ivec2(size) ? texelFetch(side, ivec2(at), 0).rgb
                                               : textureLod(side, at / size, 0.0).rgb;
}

void main() {
    vec2 at = gl_FragCoord.xy;
    if (flip != 0)
        at.y = size.y - at.y;
    if (split == 2)
        color = vec4(min(abs(pick(first, at) - pick(second, at)) * gain, 1.0), 1.0);
    else if (split == 1 && abs(at.x - divider.x) < 0.5 * divider.y)
        color = vec4(0.95, 0.95, 0.95, 1.0);
    else if (split == 1 && at.x >= divider.x)
        color = vec4(pick(second, at), 1.0);
    else
        color = vec4(pick(first, at), 1.0);
}
