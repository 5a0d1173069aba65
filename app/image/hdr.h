/* SPDX-License-Identifier: MIT */
/* hdr.h - Radiance images, .hdr: one byte of mantissa per channel and a shared exponent. */
#ifndef LAMPION_IMAGE_HDR_H
#define LAMPION_IMAGE_HDR_H

#include "app/image/pixels.h"

/* Decodes a file with scanlines in any orientation, packed or not. Untrusted files are for
 * image_read, which decodes in a sandbox. */
bool image_decode_hdr(const image_source *source, image *image, base_error *error);

#endif
