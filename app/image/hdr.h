/* SPDX-License-Identifier: MIT */
/* hdr.h - Radiance's images, .hdr: a byte of mantissa for each channel and one of exponent for all.
 */
#ifndef LAMPION_IMAGE_HDR_H
#define LAMPION_IMAGE_HDR_H

#include "app/image/pixels.h"

/* Decodes a file whose rows run from the top and from the left, packed or not. Foreign files are
 * for image_read, which does it in a sandbox. */
bool image_decode_hdr(const image_source *source, image *image, cli_error *error);

#endif
