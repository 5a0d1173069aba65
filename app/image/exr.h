/* SPDX-License-Identifier: MIT */
/* exr.h - OpenEXR files. */
#ifndef LAMPION_IMAGE_EXR_H
#define LAMPION_IMAGE_EXR_H

#include "app/image/pixels.h"

/* A named image of an OpenEXR file: channels NAME.R, NAME.G, NAME.B, or R, G, B without name. */
typedef struct image_layer {
    const char *name; /* NULL or "": the main image */
    const image *image;
} image_layer;

/* Writes 1 … IMAGE_LAYERS_MAX layers of one size into one .exr, 32-bit float. */
#define IMAGE_LAYERS_MAX 8
bool image_write_exr_layers(const char *path, const image_layer *layers, int count,
                            cli_error *error);

/* Decodes the channels R, G and B of a file; without R, those of luminance Y, in the colors of RY
 * and BY where it has these. Foreign files are for image_read, which does it in a sandbox. */
bool image_decode_exr(const image_source *source, image *image, cli_error *error);

#endif
