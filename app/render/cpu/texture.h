/* SPDX-License-Identifier: MIT */
/* texture.h - texture look-ups on the CPU, which average over a pixel's footprint, as OpenGL does
 * with anisotropic filtering. */
#ifndef LAMPION_RENDER_CPU_TEXTURE_H
#define LAMPION_RENDER_CPU_TEXTURE_H

#include "app/render/cpu/levels.h"

/* Texture coordinates of a pixel, in both sets, and their differences to the pixels beside and
 * below it. */
typedef struct cpu_footprint {
    float uv[2][2], across[2][2], down[2][2];
} cpu_footprint;

/* The texels that a footprint averages, from one level or two, around up to CPU_TAPS points each,
 * and their weights. Valid for every texture that cpu_textures_alike accepts. */
enum { CPU_TAPS = 8 };
typedef struct cpu_cover {
    int finer, levels; /* the first level, and the number of levels */
    int taps, lanes; /* points, and the distance in the arrays between the four texels around one */
    uint32_t texels[2][4 * CPU_TAPS];
    float weights[2][4 * CPU_TAPS];
} cpu_cover;

/* Finds the cover of a footprint; use->texture must be >= 0. */
void cpu_texture_cover(const cpu_textures *textures, const scene_texture_use *use,
                       const cpu_footprint *at, cpu_cover *cover);

/* Whether a cover of one use is also valid for the other. */
bool cpu_textures_alike(const cpu_textures *textures, const scene_texture_use *a,
                        const scene_texture_use *b);

/* Returns the mean over the footprint, RGBA, colors linear. */
void cpu_texture_read(const cpu_textures *textures, const scene_texture_use *use,
                      const cpu_cover *cover, float rgba[4]);

#endif
