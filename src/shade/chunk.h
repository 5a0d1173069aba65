/* SPDX-License-Identifier: MIT */
/* chunk.h - surfaces of many, a chunk of planes at a time, and lights as the kernels take them. */
#ifndef LAMPION_SHADE_CHUNK_H
#define LAMPION_SHADE_CHUNK_H

#include "src/light/packed.h"
#include "src/shade/planes.h"

/* Surfaces near each other that are shaded from the same. */
typedef struct shade_chunk {
    shade_source source;
    int phong_count; /* 0: no lobes, but a table or a BRDF */
    size_t count;
    size_t at[SHADE_SURFACES_MAX]; /* among the caller's */
    bool in_a_row;                 /* at[i] = at[0] + i */
    shade_planes planes;
    float ambient[3];
    lmp_kernel_surfaces surfaces;
    lmp_kernel_accumulated sums;
} shade_chunk;

/* Surfaces that are not in a chunk yet, and how many Phong lobes each has; and what lies over any
 * that waited. */
typedef struct shade_waiting {
    unsigned overs;
    size_t count, at[SHADE_SURFACES_MAX];
    unsigned char lobes[SHADE_SURFACES_MAX];
} shade_waiting;

/* Has one more wait, for which there is room. Inline, for every surface does. */
static inline void lmp_shade_wait(const lmp_surfaces *surfaces, size_t at, shade_waiting *waiting) {
    const size_t i = waiting->count++;
    const lmp_material *material = lmp_material_at(surfaces, at);
    int lobes = material->kind == LMP_MATERIAL_LOBES;
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        lobes = lmp_shade_phong_count(material, lmp_vec3_element(&surfaces->normal, at),
                                      lmp_vec3_element(&surfaces->view, at));
    waiting->overs |= lmp_shade_overs(material);
    waiting->at[i] = at;
    waiting->lobes[i] = (unsigned char)lobes;
}

/* Moves what is like the first of those that wait. */
void lmp_shade_take_alike(const lmp_surfaces *surfaces, bool preintegrated, shade_waiting *waiting,
                          shade_chunk *chunk);

/* Takes surfaces first + order[i] that fit and have so many Phong lobes each. */
void lmp_shade_take_lobes(const lmp_surfaces *surfaces, int lobes, size_t first,
                          const uint16_t *order, size_t count, shade_chunk *chunk);

/* Of the surfaces taken all that a kernel reads; nothing is accumulated yet. */
void lmp_shade_load_chunk(const lmp_surfaces *surfaces, shade_chunk *chunk);

/* `ambient` receives what it adds from every direction. Inline, for every chunk takes every light.
 */
static inline void lmp_shade_take_light(const lmp_light *light, lmp_packed_light *taken,
                                        lmp_rgb *ambient) {
    lmp_light_pack(light, taken);
    ambient->r += taken->ambient.r;
    ambient->g += taken->ambient.g;
    ambient->b += taken->ambient.b;
}

#endif
