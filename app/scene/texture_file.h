/* SPDX-License-Identifier: MIT */
/* texture_file.h - textures that materials refer to by name, each made once. */
#ifndef LAMPION_SCENE_TEXTURE_FILE_H
#define LAMPION_SCENE_TEXTURE_FILE_H

#include "app/scene/sources.h"
#include "app/scene/texture.h"

typedef struct texture_files {
    source_set *sources;
    texture_images images;
} texture_files;

/* Returns the last part of a path, whose parts end at slashes or backslashes. */
const char *texture_file_base_name(const char *path);

/* Finds or makes the texture of a file, which lies where the path leads or, if none can be read
 * there, beside the scene: paths are often those of another computer. A file that cannot be read or
 * decoded is noted as unsupported, and *use stays as it is. Returns false only if memory ran out.
 */
bool texture_file_use(texture_files *files, const char *path, uint32_t srgb, scene_wrap wrap_u,
                      scene_wrap wrap_v, scene_texture_use *use, base_error *error);

/* An encoded image that lies in the scene's own file. */
typedef struct texture_embedded {
    const char *name;
    const void *data; /* must stay in place as long as the texture_files */
    size_t size;
} texture_embedded;

/* Does as texture_file_use with an image that has been read. */
bool texture_embedded_use(texture_files *files, const texture_embedded *image, uint32_t srgb,
                          scene_wrap wrap_u, scene_wrap wrap_v, scene_texture_use *use,
                          base_error *error);

#endif
