/* SPDX-License-Identifier: MIT */
/* image.h - pictures: linear RGB in float, written as OpenEXR or tone-mapped to PNG. */
#ifndef LAMPION_IMAGE_H
#define LAMPION_IMAGE_H

#include "app/cli/cli.h"

/* Rows from the top, tightly packed, linear RGB. */
typedef struct image {
    int width, height;
    float *rgb; /* 3 * width * height, malloc'ed */
} image;

bool image_create(image *image, int width, int height, cli_error *error);
void image_free(image *image);

/* The exposure (a factor on radiance) that maps the picture's log-average to middle grey. */
float image_auto_exposure(const image *image);

/* Filmic curve and sRGB transfer to 8 bits: rgb8 receives 3 * width * height bytes. */
void image_tone_map(const image *image, float exposure, unsigned char *rgb8);

/* Writes by the extension of path: .png (tone-mapped with exposure) or .exr (linear, unexposed). */
bool image_write(const image *image, const char *path, float exposure, cli_error *error);

/* Writes 8-bit RGB as PNG. */
bool image_write_png8(const unsigned char *rgb8, int width, int height, const char *path,
                      cli_error *error);

/* Reads a .exr (R, G, B channels; linear) or an 8-bit .png (sRGB, linearised). */
bool image_read(const char *path, image *image, cli_error *error);

#endif
