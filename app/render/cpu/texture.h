/* SPDX-License-Identifier: MIT */
/* texture.h - the scene's textures for the CPU: levels of halved size, and look-ups that average
 * over what a pixel covers, as OpenGL has them with anisotropic filtering. */
#ifndef LAMPION_CPU_TEXTURE_H
#define LAMPION_CPU_TEXTURE_H

#include "app/scene/scene.h"

typedef struct cpu_textures cpu_textures;

/* The scene must outlive it. NULL without memory. */
cpu_textures *cpu_textures_create(const scene *scene);
void cpu_textures_destroy(cpu_textures *textures);

/* Where a pixel sees a surface's texture coordinates, of both sets, and how they change from it to
 * the pixels beside and below it. */
typedef struct cpu_footprint {
    float uv[2][2], across[2][2], down[2][2];
} cpu_footprint;

/* The mean over the footprint, RGBA, colors linear. use->texture >= 0. */
void cpu_texture_at(const cpu_textures *textures, const scene_texture_use *use,
                    const cpu_footprint *at, float rgba[4]);

#endif
