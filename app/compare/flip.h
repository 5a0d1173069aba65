/* SPDX-License-Identifier: MIT */
/* flip.h - the difference that an eye sees when two images alternate on a screen. */
#ifndef LAMPION_COMPARE_FLIP_H
#define LAMPION_COMPARE_FLIP_H

#include "app/image/image.h"

/* The mean of the LDR-FLIP of Andersson et al. 2020, 0 (equal) … 1, of images as displayed (sRGB, 0
 * … 1), at the 67 pixels a degree of a 4K screen of its own width away. False without memory. */
bool compare_flip(const image *candidate, const image *reference, double *flip);

#endif
