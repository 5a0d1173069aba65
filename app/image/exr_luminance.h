/* SPDX-License-Identifier: MIT */
/* exr_luminance.h - OpenEXR images of luminance Y and of chroma RY = (R - Y) / Y and BY = (B - Y) /
 * Y, which may be stored only at every second pixel of every second row. */
#ifndef LAMPION_IMAGE_EXR_LUMINANCE_H
#define LAMPION_IMAGE_EXR_LUMINANCE_H

#include "app/image/pixels.h"

/* Finds the weights of R, G and B in Y, by the chromaticities x, y of the primaries and of white;
 * if these are invalid, those of Rec. 709. */
void exr_luminance_weights(const float primaries[3][2], const float white[2], double weights[3]);

/* Samples of chroma, `step` pixels apart along both axes: (width + step - 1) / step in a row. */
typedef struct exr_chroma {
    float *samples;
    int step; /* 1 or 2, equal for both */
} exr_chroma;

/* Converts an image whose green holds Y to RGB; returns false if memory ran out. */
bool exr_luminance_to_rgb(image *pixels, const exr_chroma *ry, const exr_chroma *by,
                          const double weights[3]);

#endif
