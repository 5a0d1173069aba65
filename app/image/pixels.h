/* SPDX-License-Identifier: MIT */
/* pixels.h - an image in memory: linear RGB in float. */
#ifndef LAMPION_IMAGE_PIXELS_H
#define LAMPION_IMAGE_PIXELS_H

#include "app/base/error.h"

/* An image: rows from the top, tightly packed, linear RGB. */
typedef struct image {
    int width, height;
    float *rgb; /* 3 * width * height, from malloc */
} image;

#define IMAGE_SIZE_MAX   16384     /* pixels per side */
#define IMAGE_PIXELS_MAX (1 << 26) /* pixels of an image */

bool image_create(image *image, int width, int height, base_error *error);
void image_free(image *image);

/* Prepares an image for writing to `path`: overflow becomes the largest float, and NaN 0, as a .png
 * shows them; a note says how many there were. */
void image_make_finite(image *image, const char *path);

/* An untrusted file in memory, to be decoded. */
typedef struct image_source {
    const char *path; /* named in errors */
    const unsigned char *data;
    size_t size;
    long long pixels_max; /* of the image, at most IMAGE_PIXELS_MAX */
    const char *layer;    /* of an .exr: NAME of channels NAME.R …; NULL: R, G and B */
} image_source;

/* Creates an image of the size that a file claims. */
bool image_create_decoded(const image_source *source, long long width, long long height,
                          image *image, base_error *error);

#endif
