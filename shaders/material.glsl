/* SPDX-License-Identifier: MIT */
/* material.glsl - the materials of the program, glTF's, as lampion.glsl takes them: include it
 * before. */
layout(std430, binding = SHARED_GGX) readonly restrict buffer ggx_block {
    vec4 ggx_texels[];
};
#define LMP_GGX_TEXEL(i) ggx_texels[i]
#include "ggx.glsl"
