/* SPDX-License-Identifier: MIT */
/* exr.h - OpenEXR files. */
#ifndef LAMPION_IMAGE_EXR_H
#define LAMPION_IMAGE_EXR_H

#include "app/image/pixels.h"

/* A named image of an OpenEXR file: channels NAME.R, NAME.G, NAME.B, or R, G, B without a name. */
typedef struct image_layer {
    const char *name; /* NULL or "": the main image */
    const image *image;
} image_layer;

/* Writes 1 … IMAGE_LAYERS_MAX layers of one size to one .exr, 32-bit float. */
#define IMAGE_LAYERS_MAX 8
bool image_write_exr_layers(const char *path, const image_layer *layers, int count,
                            base_error *error);

/* Decodes the channels R, G and B of a file; without R, luminance Y, with the colors of RY and BY
 * if it has them. Untrusted files are for image_read, which decodes in a sandbox. */
bool image_decode_exr(const image_source *source, image *image, base_error *error);

#endif
