/* SPDX-License-Identifier: MIT */
/* texture.h - decoding of images into a builder's texels. */
#ifndef LAMPION_SCENE_TEXTURE_H
#define LAMPION_SCENE_TEXTURE_H

#include "app/scene/builder.h"

#define TEXTURE_SIDE_MAX 16384

/* Decodes a PNG, JPEG, TGA or BMP to RGBA and appends its texels; *texture gets their place and
 * size. `subject` and `name` are for messages. */
bool texture_decode(scene_builder *builder, const void *data, size_t size, const char *subject,
                    const char *name, scene_texture *texture, cli_error *error);

#endif
