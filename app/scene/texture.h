/* SPDX-License-Identifier: MIT */
/* texture.h - images on their way into a scene, which keeps them as they are, and their decoding.
 */
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

/* Images that a builder has. Zero-initialize but for the builder;
 * free() the items. */
typedef struct texture_images {
    scene_builder *builder;
    struct texture_image *items;
    size_t count;
} texture_images;

/* Appends an image of one of `formats` as it is, its size measured; *texture gets that, and where
 * its texels will be. `subject` and `name` are for messages. */
bool texture_keep(scene_builder *builder, const void *data, size_t size, texture_format formats,
                  const char *subject, const char *name, scene_texture *texture, cli_error *error);

/* The noun of what cannot be decoded, for builder_left_out. */
#define TEXTURE_UNDECODABLE "undecodable image"

/* Keeps data that stay where they are as long as `images`: once, whoever asks. Of what is no image
 * the texture's width is 0; false without memory alone. */
bool texture_keep_once(texture_images *images, const void *data, size_t size,
                       texture_format formats, const char *subject, const char *name,
                       scene_texture *texture, cli_error *error);

/* Where the texels of an image end, in bytes. */
uint64_t texture_texels_end(const scene_image *image);

/* Decodes an image to RGBA, rows from the top. */
bool texture_decode(const scene_image *image, const unsigned char *encoded, unsigned char *texels,
                    const char *subject, cli_error *error);

/* Takes the image whose texels begin there from the materials that show it. */
void texture_forget(scene_material *materials, size_t count, const scene_texture *textures,
                    const scene_image *image);

/* Replaces a builder's images by their texels, for what decodes them itself. One that cannot be
 * decoded is left out, and *error tells why; false without memory alone. */
bool texture_decode_all(scene_builder *builder, const char *subject, cli_error *error);

/* The number of the builder's texture of the same texels, color space and wrap modes, which is
 * added where there is none; -1 without memory. */
int32_t texture_use(scene_builder *builder, const scene_texture *texture);

#endif
