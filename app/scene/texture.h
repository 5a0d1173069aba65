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
    TEXTURE_WEBP = 16,
    TEXTURE_GLTF = TEXTURE_PNG | TEXTURE_JPEG | TEXTURE_WEBP,
    TEXTURE_ANY = TEXTURE_GLTF | TEXTURE_TGA | TEXTURE_BMP,
} texture_format;

/* Images that have been decoded into a builder's texels. Zero-initialize but for the builder;
 * free() the items. */
typedef struct texture_images {
    scene_builder *builder;
    struct texture_image *items;
    size_t count;
} texture_images;

/* Decodes an image of one of `formats` to RGBA and appends its texels; *texture gets their offset
 * and size. `subject` and `name` are for messages. */
bool texture_decode(scene_builder *builder, const void *data, size_t size, texture_format formats,
                    const char *subject, const char *name, scene_texture *texture,
                    cli_error *error);

/* The noun of what cannot be decoded, for builder_left_out. */
#define TEXTURE_UNDECODABLE "undecodable image"

/* Decodes data that stay where they are as long as `images`: once, whoever asks. Of what cannot be
 * decoded the texture's width is 0; false without memory alone. */
bool texture_decode_once(texture_images *images, const void *data, size_t size,
                         texture_format formats, const char *subject, const char *name,
                         scene_texture *texture, cli_error *error);

/* The number of the builder's texture of the same texels, color space and wrap modes, which is
 * added where there is none; -1 without memory. */
int32_t texture_use(scene_builder *builder, const scene_texture *texture);

#endif
