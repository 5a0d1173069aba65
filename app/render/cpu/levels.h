/* SPDX-License-Identifier: MIT */
/* levels.h - the mipmap levels of a scene's textures, each half as large as the one before it. */
#ifndef LAMPION_RENDER_CPU_LEVELS_H
#define LAMPION_RENDER_CPU_LEVELS_H

#include "app/scene/scene.h"

enum { CPU_LEVELS = 32, CPU_CURVE = 4096 };

typedef struct cpu_level {
    uint32_t width, height;
    const unsigned char *texels; /* RGBA */
} cpu_level;

typedef struct cpu_texture {
    cpu_level levels[CPU_LEVELS];
    int count; /* 0 until the levels are measured */
    bool srgb;
    uint32_t wrap_u, wrap_v;
} cpu_texture;

typedef struct cpu_textures {
    cpu_texture *of;
    size_t count;
    unsigned char *memory;           /* of the levels below the first */
    float linear[2][256];            /* the value of a byte, linear and sRGB */
    unsigned char encode[CPU_CURVE]; /* least upper bound of the sRGB byte, by a root */
} cpu_textures;

/* Makes the levels of a scene's textures; the scene must outlive them. Returns NULL if memory ran
 * out. */
cpu_textures *cpu_textures_create(const scene *scene);
void cpu_textures_destroy(cpu_textures *textures);

#endif
