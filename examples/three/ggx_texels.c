/* SPDX-License-Identifier: MIT */
/* Writes the table that ggx.glsl reads, as floats: ggx_texels > ggx.f32 */
#include <lampion/lobe.h>

#include <stdio.h>

int main(void) {
    static float texels[4 * LMP_GGX_TEXELS];
    lmp_lobe_copy_ggx_texels(texels);
    return fwrite(texels, sizeof texels, 1, stdout) == 1 && fflush(stdout) == 0 ? 0 : 1;
}
