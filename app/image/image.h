/* SPDX-License-Identifier: MIT */
/* image.h - images as files: linear RGB in float. A format that is written is a case of image.c,
 * one that is read a row of read.c; those of textures are rows of app/scene/texture.c. */
#ifndef LAMPION_IMAGE_IMAGE_H
#define LAMPION_IMAGE_IMAGE_H

#include "app/image/exr.h"
#include "app/image/hdr.h"
#include "app/image/png.h"
#include "app/image/tone.h"

/* Writes in the format of the path's extension: .png (tone-mapped for the display) or .exr (linear,
 * without exposure). */
bool image_write(const image *image, const char *path, const image_display *display,
                 base_error *error);

/* Returns the format of a path's extension, ignoring case. */
typedef enum image_format { IMAGE_UNKNOWN, IMAGE_PNG, IMAGE_EXR } image_format;
image_format image_format_of(const char *path);

/* Writes a drawing, whose colors (0 … 1) are displayed as they are, without exposure and tone
 * curve. */
bool image_write_figure(const image *image, const char *path, base_error *error);

/* Whether image_write supports the extension of path and its folder can be written; to be checked
 * before long work. */
bool image_check_path(const char *path, base_error *error);

/* Reads a .exr (R, G, B channels; linear), a .hdr (linear) or an 8-bit .png (sRGB, linearized) of
 * at most pixels_max pixels; image_read_png_text reads the text of a .png's chunk with that key, to
 * be freed. Both decode in a sandbox. */
#define IMAGE_READ_PIXELS (1 << 25) /* the default limit: 8K */
bool image_read(const char *path, long long pixels_max, image *image, base_error *error);
/* Reads a named layer of a .exr, as image_write_exr_layers writes it. */
bool image_read_layer(const char *path, const char *layer, image *image, base_error *error);
bool image_read_png_text(const char *path, const char *key, char **text, base_error *error);

#endif
