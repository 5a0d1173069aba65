/* SPDX-License-Identifier: MIT */
/* flip.h - the difference that a viewer sees when two images alternate on a screen. */
#ifndef LAMPION_IMAGE_FLIP_H
#define LAMPION_IMAGE_FLIP_H

#include "app/image/image.h"

/* Computes the mean of LDR-FLIP (Andersson et al. 2020), 0 (equal) … 1, of images as displayed
 * (sRGB, 0 … 1), at 67 pixels per degree: a 4K screen seen from its own width away. Returns false
 * if memory ran out. */
bool compare_flip(const image *candidate, const image *reference, double *flip);

#endif
