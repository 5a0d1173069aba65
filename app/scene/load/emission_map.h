/* SPDX-License-Identifier: MIT */
/* emission_map.h - what the triangles of an emissive mesh emit, by its texture. */
#ifndef LAMPION_SCENE_LOAD_EMISSION_MAP_H
#define LAMPION_SCENE_LOAD_EMISSION_MAP_H

#include "app/scene/builder.h"

/* The images of a builder that emission needs, each decoded once. */
typedef struct emission_maps {
    const scene_builder *builder;
    const scene *geometry; /* of the builder */
    size_t image_count;
    unsigned char **texels; /* per image, or NULL */
    bool *undecodable;      /* per image: whether it was tried in vain */
} emission_maps;

/* Returns false if memory ran out. Free with emission_maps_free. */
bool emission_maps_create(const scene_builder *builder, const scene *geometry, emission_maps *maps);
void emission_maps_free(emission_maps *maps);

/* Makes the texels of a material's emission map ready. Returns false if it cannot be decoded, or
 * not within the memory that there is. */
bool emission_maps_ready(emission_maps *maps, const scene_material *material);

/* Finds the mean radiance of a triangle; maps must be ready. */
void emission_maps_mean(const emission_maps *maps, const scene_material *material, size_t instance,
                        uint32_t triangle, float radiance[3]);

#endif
