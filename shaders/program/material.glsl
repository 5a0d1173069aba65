/* SPDX-License-Identifier: MIT */
/* material.glsl - the materials of the program, glTF's, as lampion.glsl takes them: include it
 * before. */
#include "texels.glsl"

TEXELS(ggx_block, ggx_texels, SHARED_GGX)
#define LMP_GGX_TEXEL(i) TEXEL(ggx_texels, i)
#include "ggx.glsl"
