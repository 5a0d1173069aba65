/* SPDX-License-Identifier: MIT */
/* center.h - when bounds are so far from 0 that float32 lacks the digits for what is inside. */
#ifndef LAMPION_SCENE_CENTER_H
#define LAMPION_SCENE_CENTER_H

#include <stdbool.h>

/* The longest side of bounds. */
double center_length(const float low[3], const float high[3]);

/* Whether what is so long, and so far away along an axis, is far. */
bool center_is_far(double distance, double length);

/* Whether bounds are far from 0; *center is then their middle, rounded so that what float32 has of
 * coordinates there differs from it by another float32. Else it is left alone. */
bool center_find(const float low[3], const float high[3], double center[3]);

#endif
