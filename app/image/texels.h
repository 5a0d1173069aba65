/* SPDX-License-Identifier: MIT */
/* texels.h - untrusted images in the form of textures: 8-bit RGBA, the values as they are stored.
 * Color profiles, gamma and orientation are ignored, as glTF requires. Each decoder measures the
 * size first, so that an image too large is rejected before anything is allocated for it. */
#ifndef LAMPION_IMAGE_TEXELS_H
#define LAMPION_IMAGE_TEXELS_H

#include <stdbool.h>
#include <stddef.h>

/* Why an image cannot be decoded. */
typedef struct texels_reason {
    char text[160];
} texels_reason;

typedef struct texels_decoder {
    /* Whether the bytes begin like a file of this format. */
    bool (*begins)(const unsigned char *data, size_t size);
    /* Finds the image's size; returns false if there is no image. */
    bool (*measure)(const unsigned char *data, size_t size, int *width, int *height,
                    texels_reason *reason);
    /* Fills width x height x 4 bytes, rows from the top; the size must be that of `measure`. */
    bool (*decode)(const unsigned char *data, size_t size, int width, int height,
                   unsigned char *rgba, texels_reason *reason);
} texels_decoder;

/* Measure and decode with stb_image, in whatever formats it is built with; for decoders. */
bool texels_stb_measure(const unsigned char *data, size_t size, int *width, int *height,
                        texels_reason *reason);
bool texels_stb_decode(const unsigned char *data, size_t size, int width, int height,
                       unsigned char *rgba, texels_reason *reason);

extern const texels_decoder texels_png, texels_jpeg, texels_webp, texels_tga, texels_bmp;

#endif
