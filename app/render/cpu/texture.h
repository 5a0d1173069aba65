/* SPDX-License-Identifier: MIT */
/* texture.h - look-ups in a scene's textures for the CPU, which average over what a pixel covers,
 * as OpenGL has them with anisotropic filtering. */
#ifndef LAMPION_CPU_TEXTURE_H
#define LAMPION_CPU_TEXTURE_H

#include "app/render/cpu/levels.h"

/* Where a pixel sees a surface's texture coordinates, of both sets, and how they change from it to
 * the pixels beside and below it. */
typedef struct cpu_footprint {
    float uv[2][2], across[2][2], down[2][2];
} cpu_footprint;

/* The texels that a footprint averages: of one level or of two, around up to CPU_TAPS points each,
 * and how much of each. It holds for every texture that is read alike. */
enum { CPU_TAPS = 8 };
typedef struct cpu_cover {
    int finer, levels; /* the first level, and how many */
    int taps, lanes;   /* points, and how far apart the four texels around one lie in the arrays */
    uint32_t texels[2][4 * CPU_TAPS];
    float weights[2][4 * CPU_TAPS];
} cpu_cover;

/* use->texture >= 0. */
void cpu_texture_cover(const cpu_textures *textures, const scene_texture_use *use,
                       const cpu_footprint *at, cpu_cover *cover);

/* Whether what covers one covers the other, too. */
bool cpu_textures_alike(const cpu_textures *textures, const scene_texture_use *a,
                        const scene_texture_use *b);

/* The mean over the footprint, RGBA, colors linear. */
void cpu_texture_read(const cpu_textures *textures, const scene_texture_use *use,
                      const cpu_cover *cover, float rgba[4]);

#endif
