/* SPDX-License-Identifier: MIT */
/* chunk.h - takes surfaces a chunk of planes at a time, and lights as the kernels read them. */
#ifndef LAMPION_SHADE_CHUNK_H
#define LAMPION_SHADE_CHUNK_H

#include "src/kernels/shade.h"
#include "src/light/packed.h"
#include "src/shade/planes.h"

/* Surfaces near each other that are shaded from the same source. */
typedef struct shade_chunk {
    shade_source source;
    int phong_count; /* 0 if there are no lobes, but a table or a BRDF */
    bool is_matte;   /* whether the Phong lobes that there are reflect nothing */
    size_t count;
    size_t at[SHADE_SURFACES_MAX]; /* indices among the caller's */
    bool in_a_row;                 /* at[i] = at[0] + i */
    shade_planes planes;
    float ambient[3];
    lmpi_kernel_surfaces surfaces;
    lmpi_kernel_accumulated sums;
} shade_chunk;

/* Surfaces that are not in a chunk yet, with the number of Phong lobes of each, and the layers over
 * any surface that waited. */
typedef struct shade_waiting {
    unsigned layer_mask;
    size_t count, at[SHADE_SURFACES_MAX];
    unsigned char lobes[SHADE_SURFACES_MAX];
} shade_waiting;

/* Adds a waiting surface, for which there must be room. Inline, because every surface takes this
 * path. */
static inline void lmpi_shade_wait(const lmp_surfaces *surfaces, size_t at,
                                   shade_waiting *waiting) {
    const size_t i = waiting->count++;
    const lmp_material *material = lmpi_material_at(surfaces, at);
    int lobes = material->kind == LMP_MATERIAL_LOBES;
    if (material->kind == LMP_MATERIAL_METALLIC_ROUGHNESS)
        lobes = lmpi_shade_phong_count(material, lmpi_vec3_element(&surfaces->normal, at),
                                       lmpi_vec3_element(&surfaces->view, at));
    waiting->layer_mask |= lmpi_shade_layer_mask(material);
    waiting->at[i] = at;
    waiting->lobes[i] = (unsigned char)lobes;
}

/* Moves the surfaces like the first waiting one into a chunk. */
void lmpi_shade_take_alike(const lmp_surfaces *surfaces, bool preintegrated, shade_waiting *waiting,
                           shade_chunk *chunk);

/* Takes surfaces first + order[i], which must fit, with `lobes` Phong lobes each. */
void lmpi_shade_take_lobes(const lmp_surfaces *surfaces, int lobes, size_t first,
                           const uint16_t *order, size_t count, shade_chunk *chunk);

/* Loads all that a kernel reads of the surfaces taken; nothing is accumulated yet. */
void lmpi_shade_load_chunk(const lmp_surfaces *surfaces, shade_chunk *chunk);

/* Packs a light; `ambient` receives what it adds from every direction. Inline, because every chunk
 * takes every light. */
static inline void lmpi_shade_take_light(const lmp_light *light, lmpi_packed_light *taken,
                                         lmp_rgb *ambient) {
    lmpi_light_pack(light, taken);
    ambient->r += taken->ambient.r;
    ambient->g += taken->ambient.g;
    ambient->b += taken->ambient.b;
}

#endif
