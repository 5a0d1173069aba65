/* SPDX-License-Identifier: MIT */
/* tone.h - exposure, and what a display shows. */
#ifndef LAMPION_IMAGE_TONE_H
#define LAMPION_IMAGE_TONE_H

#include "app/image/pixels.h"

/* The exposure (a factor on radiance) that maps the log-average of what is lit to middle gray:
 * the darkest and brightest twentieth, and pixels 8 stops darker than these, do not count: the tail
 * of a sharp lobe is as good as black. 1 for a black image. */
float image_auto_exposure(const image *image);

/* The factor that an exposure of `stops` EV means: 2^stops. */
float image_exposure_of_stops(float stops);

/* The filmic curve of shaders/shared.h and the sRGB transfer to 8 bits: rgb8 receives 3 * width *
 * height bytes. */
void image_tone_map(const image *image, float exposure, unsigned char *rgb8);

/* The sRGB transfer alone. */
void image_encode(const image *image, unsigned char *rgb8);

#endif
