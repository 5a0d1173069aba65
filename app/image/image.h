/* SPDX-License-Identifier: MIT */
/* image.h - images as files: linear RGB in float, written as OpenEXR or tone-mapped to PNG. */
#ifndef LAMPION_IMAGE_H
#define LAMPION_IMAGE_H

#include "app/image/exr.h"
#include "app/image/hdr.h"
#include "app/image/png.h"
#include "app/image/tone.h"

/* Writes by the extension of path: .png (tone-mapped for the display) or .exr (linear, unexposed).
 */
bool image_write(const image *image, const char *path, const image_display *display,
                 cli_error *error);

/* By the extension of path, whatever its case. */
typedef enum image_format { IMAGE_UNKNOWN, IMAGE_PNG, IMAGE_EXR } image_format;
image_format image_format_of(const char *path);

/* The same for a drawing, whose colors (0 … 1) are meant to be seen as they are: no exposure and
 * no tone curve. */
bool image_write_figure(const image *image, const char *path, cli_error *error);

/* True if image_write will know what to do with path and its folder can be written: ask before the
 * long work. */
bool image_check_path(const char *path, cli_error *error);

/* Reads a .exr (R, G, B channels; linear), a .hdr (linear) or an 8-bit .png (sRGB, linearized) of
 * at most pixels_max pixels, and the text of a .png's chunk of that key, to be freed. Both decode
 * in a sandbox. */
#define IMAGE_READ_PIXELS (1 << 25) /* unless a user wants more: 8K */
bool image_read(const char *path, long long pixels_max, image *image, cli_error *error);
/* The same of a named layer of a .exr, as image_write_exr_layers writes it. */
bool image_read_layer(const char *path, const char *layer, image *image, cli_error *error);
bool image_read_png_text(const char *path, const char *key, char **text, cli_error *error);

/* The key of the viewer's settings in its screenshots. */
#define IMAGE_SETTINGS_KEY "lampion"

#endif
