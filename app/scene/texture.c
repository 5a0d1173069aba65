/* SPDX-License-Identifier: MIT */
#include "app/scene/texture.h"

#include <limits.h>
#include <stb_image.h>
#include <stdlib.h>
#include <string.h>

/* What the first bytes say; the decoder would take more formats than the documented ones. */
static texture_format format_of(const unsigned char *bytes, size_t size) {
    if (size >= 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0)
        return TEXTURE_PNG;
    if (size >= 3 && memcmp(bytes, "\xff\xd8\xff", 3) == 0)
        return TEXTURE_JPEG;
    if (size >= 2 && memcmp(bytes, "BM", 2) == 0)
        return TEXTURE_BMP;
    /* TGA begins without a mark: an identifier's length, a color map or none, a kind of image. */
    const unsigned kind = size >= 18 ? bytes[2] : 0;
    const bool mapped = kind == 1 || kind == 9, plain = (kind & 7) == 2 || (kind & 7) == 3;
    return (mapped && bytes[1] == 1) || (plain && kind <= 11 && bytes[1] <= 1) ? TEXTURE_TGA
                                                                               : (texture_format)0;
}

/* The most pixels that a byte of a file holds: one bit each under deflate, a bit for each block of
 * 64, runs of 128, one bit each. The decoder makes up what a file of fewer bytes lacks. */
static size_t pixels_a_byte(texture_format format) {
    return format == TEXTURE_PNG    ? 8 * 1032
           : format == TEXTURE_JPEG ? 512
           : format == TEXTURE_TGA  ? 128
                                    : 8;
}

bool texture_decode(scene_builder *builder, const void *data, size_t size, texture_format formats,
                    const char *subject, const char *name, scene_texture *texture,
                    cli_error *error) {
    int width, height, channels;
    if (size > INT_MAX || !(format_of(data, size) & formats) ||
        !stbi_info_from_memory(data, (int)size, &width, &height, &channels))
        return cli_fail(error, subject, "has a texture \"%.200s\" that is no %s", name,
                        formats == TEXTURE_GLTF ? "PNG or JPEG" : "PNG, JPEG, TGA or BMP");
    if (width < 1 || height < 1 || width > TEXTURE_SIDE_MAX || height > TEXTURE_SIDE_MAX)
        return cli_fail(error, subject,
                        "has a texture \"%.200s\" of %d x %d pixels (at most %d x %d)", name, width,
                        height, TEXTURE_SIDE_MAX, TEXTURE_SIDE_MAX);
    if ((size_t)width * (size_t)height > size * pixels_a_byte(format_of(data, size)))
        return cli_fail(
            error, subject,
            "has a texture \"%.200s\" of %d x %d pixels in %zu bytes (is it truncated?)", name,
            width, height, size);
    unsigned char *pixels = stbi_load_from_memory(data, (int)size, &width, &height, &channels, 4);
    if (!pixels)
        return cli_fail(error, subject, "has a texture \"%.200s\" that cannot be decoded: %s", name,
                        stbi_failure_reason());
    const size_t bytes = 4 * (size_t)width * (size_t)height;
    texture->first_byte = builder_count(builder, BLOB_TEXELS);
    texture->width = (uint32_t)width;
    texture->height = (uint32_t)height;
    unsigned char *texels = builder_append(builder, BLOB_TEXELS, bytes);
    if (texels)
        memcpy(texels, pixels, bytes);
    stbi_image_free(pixels);
    return texels || cli_fail(error, subject, "has textures that do not fit into memory");
}

struct texture_image {
    const void *data;
    size_t size;
    scene_texture texture;
};

bool texture_decode_once(texture_images *images, const void *data, size_t size,
                         texture_format formats, const char *subject, const char *name,
                         scene_texture *texture, cli_error *error) {
    for (size_t i = 0; i < images->count; i++) {
        const struct texture_image *known = &images->items[i];
        if (known->data == data && known->size == size) {
            texture->first_byte = known->texture.first_byte;
            texture->width = known->texture.width;
            texture->height = known->texture.height;
            return true;
        }
    }
    struct texture_image *items = realloc(images->items, (images->count + 1) * sizeof *items);
    if (!items)
        return cli_fail(error, subject, "has textures that do not fit into memory");
    images->items = items;
    if (!texture_decode(images->builder, data, size, formats, subject, name, texture, error))
        return false;
    items[images->count++] = (struct texture_image) { data, size, *texture };
    return true;
}

static bool is_same(const scene_texture *a, const scene_texture *b) {
    return a->first_byte == b->first_byte && a->width == b->width && a->height == b->height &&
           a->srgb == b->srgb && a->wrap_u == b->wrap_u && a->wrap_v == b->wrap_v;
}

int32_t texture_use(scene_builder *builder, const scene_texture *texture) {
    const scene_texture *known = builder_items(builder, BLOB_TEXTURES);
    const size_t count = builder_count(builder, BLOB_TEXTURES);
    for (size_t i = 0; i < count; i++)
        if (is_same(&known[i], texture))
            return (int32_t)i;
    scene_texture *added = builder_append(builder, BLOB_TEXTURES, 1);
    if (!added)
        return -1;
    *added = *texture;
    return (int32_t)count;
}
