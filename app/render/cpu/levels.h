/* SPDX-License-Identifier: MIT */
/* levels.h - the levels of a scene's textures, each half as large as the one before it, as
 * look-ups read them. */
#ifndef LAMPION_CPU_LEVELS_H
#define LAMPION_CPU_LEVELS_H

#include "app/scene/scene.h"

enum { CPU_LEVELS = 32, CPU_CURVE = 4096 };

typedef struct cpu_level {
    uint32_t width, height;
    const unsigned char *texels; /* RGBA */
} cpu_level;

typedef struct cpu_texture {
    cpu_level levels[CPU_LEVELS];
    int count; /* 0 until they are measured */
    bool srgb;
    uint32_t wrap_u, wrap_v;
} cpu_texture;

typedef struct cpu_textures {
    cpu_texture *of;
    size_t count;
    unsigned char *memory;           /* of the levels below the first */
    float linear[2][256];            /* what a byte means: by itself, and of sRGB */
    unsigned char encode[CPU_CURVE]; /* a byte of sRGB at most, from the root of a linear value */
} cpu_textures;

/* The scene must outlive it. NULL without memory. */
cpu_textures *cpu_textures_create(const scene *scene);
void cpu_textures_destroy(cpu_textures *textures);

#endif
