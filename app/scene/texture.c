/* SPDX-License-Identifier: MIT */
#include "app/scene/texture.h"

#include "app/image/texels.h"
#include "app/scene/name.h"

#include <stdlib.h>
#include <string.h>

/* A format and the most pixels that plausible files of it have, per byte and in addition: a bit per
 * pixel under deflate, a bit per block of 64, runs of 128, a bit per pixel; WebP describes a
 * uniform image of any size in some thirty bytes. Decoders invent what a shorter file lacks. */
typedef struct format_row {
    texture_format format;
    const texels_decoder *decoder;
    size_t pixels_a_byte, pixels_besides;
} format_row;

static const format_row *format_of(const unsigned char *bytes, size_t size,
                                   texture_format formats) {
    /* TGA is last because it has no signature. */
    static const format_row rows[] = { { TEXTURE_PNG, &texels_png, 8 * 1032, 0 },
                                       { TEXTURE_JPEG, &texels_jpeg, 512, 0 },
                                       { TEXTURE_WEBP, &texels_webp, 8 * 1032, 4096 * 4096 },
                                       { TEXTURE_BMP, &texels_bmp, 8, 0 },
                                       { TEXTURE_TGA, &texels_tga, 128, 0 } };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        if ((rows[i].format & formats) && rows[i].decoder->begins(bytes, size))
            return &rows[i];
    return NULL;
}

static bool fail_decoding(const char *subject, const char *name, const texels_reason *reason,
                          base_error *error) {
    return base_fail(error, subject, "has a texture \"%.200s\" that cannot be decoded: %s", name,
                     reason->text);
}

static bool check_size(const format_row *format, size_t size, int width, int height,
                       const char *subject, const char *name, base_error *error) {
    if (width < 1 || height < 1 || width > TEXTURE_SIDE_MAX || height > TEXTURE_SIDE_MAX)
        return base_fail(error, subject,
                         "has a texture \"%.200s\" of %d x %d pixels (at most %d x %d)", name,
                         width, height, TEXTURE_SIDE_MAX, TEXTURE_SIDE_MAX);
    if ((size_t)width * (size_t)height > size * format->pixels_a_byte + format->pixels_besides)
        return base_fail(
            error, subject,
            "has a texture \"%.200s\" of %d x %d pixels in %zu bytes (is it truncated?)", name,
            width, height, size);
    return true;
}

static bool fail_format(texture_format formats, const char *subject, const char *name,
                        base_error *error) {
    return base_fail(error, subject, "has a texture \"%.200s\" that is not a %s", name,
                     formats == TEXTURE_GLTF ? "PNG, JPEG or WebP" : "PNG, JPEG, WebP, TGA or BMP");
}

bool texture_keep(scene_builder *builder, const void *data, size_t size, texture_format formats,
                  const char *subject, const char *name, scene_texture *texture,
                  base_error *error) {
    const format_row *const format = format_of(data, size, formats);
    texels_reason reason;
    int width, height;
    if (!format)
        return fail_format(formats, subject, name, error);
    if (!format->decoder->measure(data, size, &width, &height, &reason))
        return fail_decoding(subject, name, &reason, error);
    if (!check_size(format, size, width, height, subject, name, error))
        return false;
    const size_t before = builder_count(builder, BLOB_IMAGES);
    scene_image *image = builder_append(builder, BLOB_IMAGES, 1);
    unsigned char *encoded = image ? builder_append(builder, BLOB_ENCODED, size) : NULL;
    if (!encoded)
        return base_fail(error, subject, "has textures that do not fit into memory");
    memcpy(encoded, data, size);
    scene_clean_name(image->name, name);
    image->width = (uint32_t)width;
    image->height = (uint32_t)height;
    image->formats = formats;
    image->first_byte = builder_count(builder, BLOB_ENCODED) - size;
    image->size = size;
    image->first_texel = before ? blob_first_texel(texture_texels_end(image - 1)) : 0;
    texture->first_byte = image->first_texel;
    texture->width = image->width;
    texture->height = image->height;
    return true;
}

uint64_t texture_texels_end(const scene_image *image) {
    return image->first_texel + 4 * (uint64_t)image->width * image->height;
}

bool texture_decode(const scene_image *image, const unsigned char *encoded, unsigned char *texels,
                    const char *subject, base_error *error) {
    const unsigned char *bytes = encoded + image->first_byte;
    const size_t size = image->size;
    const texture_format formats = (texture_format)image->formats;
    const format_row *const format = format_of(bytes, size, formats);
    const int width = (int)image->width, height = (int)image->height;
    texels_reason reason = { "its size is another one" };
    int found[2];
    if (!format)
        return fail_format(formats, subject, image->name, error);
    return (format->decoder->measure(bytes, size, &found[0], &found[1], &reason) &&
            found[0] == width && found[1] == height &&
            format->decoder->decode(bytes, size, width, height, texels, &reason)) ||
           fail_decoding(subject, image->name, &reason, error);
}

void texture_forget(scene_material *materials, size_t count, const scene_texture *textures,
                    const scene_image *image) {
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < SCENE_MAPS; k++) {
            int32_t *texture = &materials[i].maps[k].texture;
            if (*texture >= 0 && textures[*texture].first_byte == image->first_texel)
                *texture = -1;
        }
}

bool texture_decode_all(scene_builder *builder, const char *subject, base_error *error) {
    const scene_image *images = builder_items(builder, BLOB_IMAGES);
    const unsigned char *encoded = builder_items(builder, BLOB_ENCODED);
    for (size_t i = 0; i < builder_count(builder, BLOB_IMAGES); i++) {
        const size_t before = builder_count(builder, BLOB_TEXELS);
        const size_t more = (size_t)texture_texels_end(&images[i]) - before;
        unsigned char *texels = builder_append(builder, BLOB_TEXELS, more);
        if (!texels)
            return base_fail(error, subject, "has textures that do not fit into memory");
        if (texture_decode(&images[i], encoded, texels + images[i].first_texel - before, subject,
                           error))
            continue;
        if (base_is_out_of_memory(error))
            return false;
        texture_forget(builder_items(builder, BLOB_MATERIALS),
                       builder_count(builder, BLOB_MATERIALS),
                       builder_items(builder, BLOB_TEXTURES), &images[i]);
        builder_unsupported(builder, images[i].name, TEXTURE_UNDECODABLE, 1);
    }
    builder->arrays[BLOB_IMAGES].count = builder->arrays[BLOB_ENCODED].count = 0;
    return true;
}

struct texture_image {
    const void *data;
    size_t size;
    scene_texture texture;
};

bool texture_keep_once(texture_images *images, const void *data, size_t size,
                       texture_format formats, const char *subject, const char *name,
                       scene_texture *texture, base_error *error) {
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
        return base_fail(error, subject, "has textures that do not fit into memory");
    images->items = items;
    base_error reason;
    if (!texture_keep(images->builder, data, size, formats, subject, name, texture, &reason)) {
        if (base_is_out_of_memory(&reason))
            return base_fail(error, NULL, "%s", reason.text);
        texture->width = texture->height = 0;
    }
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
