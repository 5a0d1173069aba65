/* SPDX-License-Identifier: MIT */
/* exr_luminance.h - OpenEXR images of luminance Y and of chroma RY = (R - Y) / Y and
 * BY = (B - Y) / Y, which may be stored at every second pixel of every second row alone. */
#ifndef LAMPION_IMAGE_EXR_LUMINANCE_H
#define LAMPION_IMAGE_EXR_LUMINANCE_H

#include "app/image/pixels.h"

/* The fractions of R, G and B in Y, by the chromaticities x, y of the primaries and of white; those
 * of Rec. 709 where these make no sense. */
void exr_luminance_weights(const float primaries[3][2], const float white[2], double weights[3]);

/* Samples of chroma, `step` pixels apart along both axes: (width + step - 1) / step in a row. */
typedef struct exr_chroma {
    float *samples;
    int step; /* 1 or 2, the same for both */
} exr_chroma;

/* Makes the colors of an image whose green holds Y; false without memory. */
bool exr_luminance_to_rgb(image *pixels, const exr_chroma *ry, const exr_chroma *by,
                          const double weights[3]);

#endif
