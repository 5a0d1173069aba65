/* SPDX-License-Identifier: MIT */
/* texture.h - images on their way into a scene, which stores them encoded, and their decoding. */
#ifndef LAMPION_SCENE_TEXTURE_H
#define LAMPION_SCENE_TEXTURE_H

#include "app/scene/builder.h"

#define TEXTURE_SIDE_MAX 16384

/* Formats of images, as bits, for the set that a kind of scene file may contain. */
typedef enum texture_format {
    TEXTURE_PNG = 1,
    TEXTURE_JPEG = 2,
    TEXTURE_TGA = 4,
    TEXTURE_BMP = 8,
    TEXTURE_WEBP = 16,
    TEXTURE_GLTF = TEXTURE_PNG | TEXTURE_JPEG | TEXTURE_WEBP,
    TEXTURE_ANY = TEXTURE_GLTF | TEXTURE_TGA | TEXTURE_BMP,
} texture_format;

/* The images of a builder. Zero-initialize all but the builder; free() the items. */
typedef struct texture_images {
    scene_builder *builder;
    struct texture_image *items;
    size_t count;
} texture_images;

/* Appends an encoded image of one of `formats`; *texture gets its size and the offset of its
 * texels. `subject` and `name` are for messages. */
bool texture_keep(scene_builder *builder, const void *data, size_t size, texture_format formats,
                  const char *subject, const char *name, scene_texture *texture, base_error *error);

/* The noun that builder_unsupported takes for an image that cannot be decoded. */
#define TEXTURE_UNDECODABLE "undecodable image"

/* Appends an encoded image once, however often it is requested; the data must stay in place as long
 * as `images`. If the data are not an image, the texture's width is 0. Returns false only if memory
 * ran out. */
bool texture_keep_once(texture_images *images, const void *data, size_t size,
                       texture_format formats, const char *subject, const char *name,
                       scene_texture *texture, base_error *error);

/* Returns the byte offset of the end of an image's texels. */
uint64_t texture_texels_end(const scene_image *image);

/* Decodes an image to RGBA, rows from the top. */
bool texture_decode(const scene_image *image, const unsigned char *encoded, unsigned char *texels,
                    const char *subject, base_error *error);

/* Removes from the materials the image whose texels begin at that offset. */
void texture_forget(scene_material *materials, size_t count, const scene_texture *textures,
                    const scene_image *image);

/* Replaces a builder's images by their texels, for readers that decode them themselves. An image
 * that cannot be decoded is dropped, with the reason in *error; returns false only if memory ran
 * out. */
bool texture_decode_all(scene_builder *builder, const char *subject, base_error *error);

/* Returns the number of the builder's texture with the same texels, color space and wrap modes,
 * adding it if there is none; -1 if memory ran out. */
int32_t texture_use(scene_builder *builder, const scene_texture *texture);

#endif
