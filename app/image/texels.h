/* SPDX-License-Identifier: MIT */
/* texels.h - foreign images as textures want them: 8 bits, RGBA, the numbers as they are stored.
 * Color profiles, gamma and orientation are ignored, as glTF wants. Each decoder first tells the
 * size, so that an image too large is refused before anything is allocated for it. */
#ifndef LAMPION_IMAGE_TEXELS_H
#define LAMPION_IMAGE_TEXELS_H

#include "app/cli/cli.h"

/* Why an image cannot be decoded. */
typedef struct texels_reason {
    char text[160];
} texels_reason;

typedef struct texels_decoder {
    /* Whether the bytes begin as this format does. */
    bool (*begins)(const unsigned char *data, size_t size);
    /* The image's size; false if there is none. */
    bool (*measure)(const unsigned char *data, size_t size, int *width, int *height,
                    texels_reason *reason);
    /* Fills width x height x 4 bytes, rows from the top; the size is what `measure` gave. */
    bool (*decode)(const unsigned char *data, size_t size, int width, int height,
                   unsigned char *rgba, texels_reason *reason);
} texels_decoder;

/* By stb_image, whatever formats it is built with: for a decoder. */
bool texels_stb_measure(const unsigned char *data, size_t size, int *width, int *height,
                        texels_reason *reason);
bool texels_stb_decode(const unsigned char *data, size_t size, int width, int height,
                       unsigned char *rgba, texels_reason *reason);

extern const texels_decoder texels_png, texels_jpeg, texels_webp, texels_tga, texels_bmp;

#endif
