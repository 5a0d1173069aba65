/* SPDX-License-Identifier: MIT */
/* srgb.h - sRGB's transfer function and luminance (IEC 61966-2-1). */
#ifndef LAMPION_IMAGE_SRGB_H
#define LAMPION_IMAGE_SRGB_H

#include <math.h>

/* Returns the linear value of a stored one, 0 … 1; in double, so that after rounding the bits of
 * floats and bytes do not depend on the machine's math library. */
static inline double image_srgb_to_linear(double stored) {
    return stored <= 0.04045 ? stored / 12.92 : pow((stored + 0.055) / 1.055, 2.4);
}

/* Returns the relative luminance of a linear color. */
static inline double image_luminance(const float *rgb) {
    return 0.2126 * (double)rgb[0] + 0.7152 * (double)rgb[1] + 0.0722 * (double)rgb[2];
}

#endif
