/* SPDX-License-Identifier: MIT */
/* texture.h - decoding of images into a builder's texels. */
#ifndef LAMPION_SCENE_TEXTURE_H
#define LAMPION_SCENE_TEXTURE_H

#include "app/scene/builder.h"

#define TEXTURE_SIDE_MAX 16384

/* Formats of images, as bits: what a kind of scene file may hold. */
typedef enum texture_format {
    TEXTURE_PNG = 1,
    TEXTURE_JPEG = 2,
    TEXTURE_TGA = 4,
    TEXTURE_BMP = 8,
    TEXTURE_GLTF = TEXTURE_PNG | TEXTURE_JPEG,
    TEXTURE_ANY = TEXTURE_GLTF | TEXTURE_TGA | TEXTURE_BMP,
} texture_format;

/* Decodes an image of one of `formats` to RGBA and appends its texels; *texture gets their place
 * and size. `subject` and `name` are for messages. */
bool texture_decode(scene_builder *builder, const void *data, size_t size, texture_format formats,
                    const char *subject, const char *name, scene_texture *texture,
                    cli_error *error);

#endif
