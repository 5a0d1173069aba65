/* SPDX-License-Identifier: MIT */
/* areas.glsl - the program's lights that are areas, as area.glsl takes them: include it after
 * material.glsl, which has texels.glsl, and before lampion.glsl. Shaders of frames without areas do
 * not. */
TEXELS(areas_block, areas_texels, SHARED_AREAS)
vec4 areas_texel(int i, int k) {
    return TEXEL(areas_texels, SHARED_AREA_TEXELS * i + k);
}
#define LMP_AREA_COUNT       int(size_lights.w)
#define LMP_AREA_TEXEL(i, k) areas_texel(i, k)
