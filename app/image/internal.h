/* SPDX-License-Identifier: MIT */
/* internal.h - the file formats, one source each. */
#ifndef LAMPION_IMAGE_INTERNAL_H
#define LAMPION_IMAGE_INTERNAL_H

#include "app/image/image.h"

bool image_read_png(const char *path, image *image, cli_error *error);
bool image_read_exr(const char *path, image *image, cli_error *error);

/* image_create for an image whose size a file claims. */
bool image_create_read(const char *path, long long width, long long height, image *image,
                       cli_error *error);

#endif
