/* SPDX-License-Identifier: MIT */
/* The paper's own pass, kept only to be timed (lampion bench gpu): a full-screen fragment shader
 * that projects every light to its coefficients in each pixel and multiplies their sum with the
 * material's. Unrolled, constants folded: the paper's method at its best. */
#include "gbuffer.glsl"
#include "shared.h"

#define LMP_LIGHT_COUNT       int(size_lights.z)
#define LMP_LIGHT_SPHERE(i)   lights[i].sphere
#define LMP_LIGHT_RADIANCE(i) lights[i].radiance.rgb
#include "lampion.glsl"

#include "pixel.glsl"

layout(location = 0) out vec4 radiance;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int kind = pixel_kind(at);
    radiance = vec4(background.rgb, 1.0);
    if (kind == SHARED_KIND_LIGHT) {
        radiance.rgb = pixel_light_radiance(at);
    } else if (kind == SHARED_KIND_SURFACE) {
        pixel p = pixel_read(at);
        radiance.rgb = lmp_shade_coefficients(p.surface, p.material) + pixel_emission(at);
    }
}
