/* SPDX-License-Identifier: MIT */
/* lights.glsl - lampionLight: the light that a surface of the world reflects towards `view`. The engines' own preprocessors
 * do not understand lampion.glsl: pack.sh expands this file by that of C. LAMPION_LAST_BAND stays, to be defined by
 * glsl.js; that it counts as 0 in conditions is as good as any other band. */
uniform highp sampler2D lampionLights, lampionTexels;
uniform int lampionCount;
vec4 lampionTexel(int i) {
    return texelFetch(lampionLights, ivec2(i % 1024, i / 1024), 0);
}
#define LMP_BANDS               (LAMPION_LAST_BAND + 1)
#define LMP_WINDOW              LMP_WINDOW_HANNING
#define LMP_LIGHT_COUNT         lampionCount
#define LMP_LIGHT_SPHERE(i)     lampionTexel(2 * (i))
#define LMP_LIGHT_RADIANCE(i)   lampionTexel(2 * (i) + 1).rgb
#define LMP_GGX_TEXEL(i)        texelFetch(lampionTexels, ivec2((i) % 32, (i) / 32), 0)
#include "ggx.glsl"
#include "lampion.glsl"
vec3 lampionLight(vec3 position, vec3 normal, vec3 view, vec3 color, float metallic, float roughness) {
    return lmp_shade_zonal(lmp_surface(position, normal, view), lmp_metallic_roughness(color, metallic, roughness));
}
