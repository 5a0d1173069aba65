/* SPDX-License-Identifier: MIT */
/* The paper's own pass, kept only for its time (lampion bench gpu): a full-screen fragment shader
 * that projects every light to its n² coefficients in each pixel, adds them up, and multiplies the
 * sums with the material's (paper Eq. 12, 13 and 4). Unrolled and with constants folded, but
 * without the library's shortcuts. */
#include "gbuffer.glsl"
#include "shared.h"

#include "light.glsl"
#include "material.glsl"
#include "lampion.glsl"
#include "coefficients.glsl"

#include "pixel.glsl"

layout(location = 0) out vec4 radiance;

vec3 paper_shade(lmp_surface surface, lmp_lobes lobes) {
    vec3 sum[LMP_SH_COUNT];
    float sh[LMP_SH_COUNT], diffuse[LMP_BANDS];
    LMP_EACH glossy[LMP_BANDS];
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m))                                                                          \
        sum[LMP_INDEX(l, m)] = sum[LMP_INDEX(l, -m)] = vec3(0.0);
#define LMP_COLUMN(m) LMP_FOR_COLUMN(LMP_ROW, m)
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_ROW

    for (int i = 0; i < LMP_LIGHT_COUNT; i++) {
        lmp_cap_project(lmp_light_find_cap(i, surface.position), sh);
        vec3 color = lmp_light_color(i, surface.position);
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        sum[LMP_INDEX(l, m)] += color * sh[LMP_INDEX(l, m)];                                       \
        if (m > 0)                                                                                 \
            sum[LMP_INDEX(l, -m)] += color * sh[LMP_INDEX(l, -m)];                                 \
    }
        LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_ROW
    }

    lmp_lobe_make_diffuse(diffuse);
    vec3 diffuse_response = vec3(0.0);
    lmp_sh_eval(surface.normal, sh);
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        float factor = lmp_window_weight(l) * diffuse[LMP_BAND(l)];                                \
        diffuse_response += factor * sh[LMP_INDEX(l, m)] * sum[LMP_INDEX(l, m)];                   \
        if (m > 0)                                                                                 \
            diffuse_response += factor * sh[LMP_INDEX(l, -m)] * sum[LMP_INDEX(l, -m)];             \
    }
    LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_ROW
    vec3 reflected = lobes.diffuse / LMP_PI * diffuse_response;
    do {
        lmp_lobe_make_phong(lobes.exponent, glossy);
        for (int k = 0; k < LMP_LOBES; k++) {
            vec3 glossy_response = vec3(0.0);
            lmp_sh_eval(LMP_LOBE(lobes.axis, k), sh);
#define LMP_ROW(l, m)                                                                              \
    if (LMP_INSIDE(l, m)) {                                                                        \
        float factor = LMP_LOBE(glossy[LMP_BAND(l)], k);                                           \
        glossy_response += factor * sh[LMP_INDEX(l, m)] * sum[LMP_INDEX(l, m)];                    \
        if (m > 0)                                                                                 \
            glossy_response += factor * sh[LMP_INDEX(l, -m)] * sum[LMP_INDEX(l, -m)];              \
    }
            LMP_FOR_COLUMNS(LMP_COLUMN)
#undef LMP_ROW
#undef LMP_COLUMN
            reflected += LMP_LOBE(lobes.weight, k) * glossy_response;
        }
    } while (lmp_lobes_next(lobes));
    return max(reflected, vec3(0.0));
}

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    int kind = pixel_kind(at);
    radiance = vec4(background.rgb, 1.0);
    if (kind == SHARED_KIND_LIGHT) {
        radiance.rgb = pixel_light_radiance(at);
    } else if (kind >= SHARED_KIND_SURFACE) {
        pixel p = pixel_read(at);
        radiance.rgb = paper_shade(p.surface, pixel_lobes(p)) + pixel_emission(at);
    }
}
