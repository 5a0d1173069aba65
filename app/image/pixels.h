/* SPDX-License-Identifier: MIT */
/* pixels.h - an image in memory: linear RGB in float. */
#ifndef LAMPION_IMAGE_PIXELS_H
#define LAMPION_IMAGE_PIXELS_H

#include "app/cli/cli.h"

/* Rows from the top, tightly packed, linear RGB. */
typedef struct image {
    int width, height;
    float *rgb; /* 3 * width * height, malloc'ed */
} image;

#define IMAGE_SIZE_MAX   16384     /* pixels a side */
#define IMAGE_PIXELS_MAX (1 << 26) /* of an image */

bool image_create(image *image, int width, int height, cli_error *error);
void image_free(image *image);

/* Before it is written to `path`: what overflowed becomes the largest float, what is no number 0,
 * as a .png shows them, and a note says how many. */
void image_make_finite(image *image, const char *path);

/* A foreign file in memory, to be decoded. */
typedef struct image_source {
    const char *path; /* named in errors */
    const unsigned char *data;
    size_t size;
    long long pixels_max; /* of the image, at most IMAGE_PIXELS_MAX */
    const char *layer;    /* of an .exr: NAME of channels NAME.R …; NULL: R, G and B */
} image_source;

/* image_create for the size that a file claims. */
bool image_create_decoded(const image_source *source, long long width, long long height,
                          image *image, cli_error *error);

#endif
