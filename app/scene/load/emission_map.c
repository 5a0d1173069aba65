/* SPDX-License-Identifier: MIT */
#include "app/scene/load/emission_map.h"

#include "app/scene/instance.h"
#include "app/scene/texture.h"
#include "app/scene/texture_at.h"

#include <stdlib.h>

bool emission_maps_create(const scene_builder *builder, const scene *geometry,
                          emission_maps *maps) {
    const size_t count = builder_count(builder, BLOB_IMAGES);
    *maps = (emission_maps) { .builder = builder,
                              .geometry = geometry,
                              .image_count = count,
                              .texels = calloc(count + 1, sizeof *maps->texels),
                              .undecodable = calloc(count + 1, sizeof *maps->undecodable) };
    if (maps->texels && maps->undecodable)
        return true;
    emission_maps_free(maps);
    return false;
}

void emission_maps_free(emission_maps *maps) {
    for (size_t i = 0; maps->texels && i < maps->image_count; i++)
        free(maps->texels[i]);
    free(maps->texels);
    free(maps->undecodable);
}

/* Returns the number of the image that a texture shows, image_count if there is none. */
static size_t image_of(const emission_maps *maps, const scene_texture *texture) {
    const scene_image *images = builder_items(maps->builder, BLOB_IMAGES);
    size_t i = 0;
    while (i < maps->image_count && images[i].first_texel != texture->first_byte)
        i++;
    return i;
}

static const scene_texture *texture_of(const emission_maps *maps, const scene_material *material) {
    const scene_texture *textures = builder_items(maps->builder, BLOB_TEXTURES);
    return &textures[material->emission_map.texture];
}

bool emission_maps_ready(emission_maps *maps, const scene_material *material) {
    if (material->emission_map.texture < 0)
        return true;
    const size_t number = image_of(maps, texture_of(maps, material));
    if (number == maps->image_count || maps->undecodable[number])
        return false;
    if (maps->texels[number])
        return true;
    const scene_image *image =
        (const scene_image *)builder_items(maps->builder, BLOB_IMAGES) + number;
    const size_t size = 4 * (size_t)image->width * image->height;
    unsigned char *texels = malloc(size);
    base_error reason;
    if (texels &&
        texture_decode(image, builder_items(maps->builder, BLOB_ENCODED), texels, "", &reason)) {
        maps->texels[number] = texels;
        return true;
    }
    free(texels);
    maps->undecodable[number] = true;
    return false;
}

void emission_maps_mean(const emission_maps *maps, const scene_material *material, size_t instance,
                        uint32_t triangle, float radiance[3]) {
    double rgba[4] = { 1, 1, 1, 1 };
    if (material->emission_map.texture >= 0) {
        const scene_vertex *corners[3];
        double uv[3][2];
        scene_texture texture = *texture_of(maps, material);
        const scene one = { .textures = &texture,
                            .texels = maps->texels[image_of(maps, &texture)] };
        scene_texture_use use = material->emission_map;
        texture.first_byte = 0;
        use.texture = 0;
        scene_triangle_vertices(maps->geometry, instance, triangle, corners);
        for (int i = 0; i < 3; i++)
            for (int k = 0; k < 2; k++)
                uv[i][k] = (double)corners[i]->uv[use.set][k];
        texture_mean_at(&one, &use, uv, rgba);
    }
    for (int c = 0; c < 3; c++)
        radiance[c] = (float)(rgba[c] * (double)material->emission[c]);
}
