/* SPDX-License-Identifier: MIT */
/* png.h - PNG files of 8 bits. */
#ifndef LAMPION_IMAGE_PNG_H
#define LAMPION_IMAGE_PNG_H

#include "app/image/pixels.h"

/* Writes 8-bit RGB as PNG. */
bool image_write_png8(const unsigned char *rgb8, int width, int height, const char *path,
                      cli_error *error);

/* The same with a text chunk (iTXt, UTF-8, compressed), or with NULL without. */
#define IMAGE_TEXT_MAX (1 << 22)
typedef struct image_text {
    const char *key, *text;
} image_text;
bool image_write_png8_text(const unsigned char *rgb8, int width, int height, const image_text *text,
                           const char *path, cli_error *error);

/* Decodes a file, whose sRGB is linearized, and the text of one: the first of that key, at most
 * IMAGE_TEXT_MAX bytes, to be freed. Foreign files are for image_read, which does it in a sandbox.
 */
bool image_decode_png(const image_source *source, image *image, cli_error *error);
bool image_decode_png_text(const image_source *source, const char *key, char **text,
                           cli_error *error);

#endif
