/* SPDX-License-Identifier: MIT */
#include "app/scene/texture.h"

#include <limits.h>
#include <stb_image.h>
#include <string.h>

bool texture_decode(scene_builder *builder, const void *data, size_t size, const char *subject,
                    const char *name, scene_texture *texture, cli_error *error) {
    int width, height, channels;
    if (size > INT_MAX || !stbi_info_from_memory(data, (int)size, &width, &height, &channels))
        return cli_fail(error, subject, "has a texture \"%.200s\" that is no PNG, JPEG, TGA or BMP",
                        name);
    if (width < 1 || height < 1 || width > TEXTURE_SIDE_MAX || height > TEXTURE_SIDE_MAX)
        return cli_fail(error, subject,
                        "has a texture \"%.200s\" of %d x %d pixels (at most %d x %d)", name, width,
                        height, TEXTURE_SIDE_MAX, TEXTURE_SIDE_MAX);
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
