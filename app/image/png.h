/* SPDX-License-Identifier: MIT */
/* png.h - PNG files with 8 bits per channel. */
#ifndef LAMPION_IMAGE_PNG_H
#define LAMPION_IMAGE_PNG_H

#include "app/image/pixels.h"

/* Writes 8-bit RGB as PNG. */
bool image_write_png8(const unsigned char *rgb8, int width, int height, const char *path,
                      base_error *error);

/* Writes 8-bit RGB as PNG with a text chunk (iTXt, UTF-8, compressed), or without one if text is
 * NULL. */
#define IMAGE_TEXT_MAX (1 << 22)
typedef struct image_text {
    const char *key, *text;
} image_text;
bool image_write_png8_text(const unsigned char *rgb8, int width, int height, const image_text *text,
                           const char *path, base_error *error);

/* Decode a file, linearizing its sRGB, and the text of a file: the first chunk with that key, at
 * most IMAGE_TEXT_MAX bytes, to be freed. Untrusted files are for image_read, which decodes in a
 * sandbox. */
bool image_decode_png(const image_source *source, image *image, base_error *error);
bool image_decode_png_text(const image_source *source, const char *key, char **text,
                           base_error *error);

#endif
