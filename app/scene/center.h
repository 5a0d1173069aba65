/* SPDX-License-Identifier: MIT */
/* center.h - whether bounds are so far from 0 that float32 lacks digits for what is inside them. */
#ifndef LAMPION_SCENE_CENTER_H
#define LAMPION_SCENE_CENTER_H

#include <stdbool.h>

/* Returns the longest side of bounds. */
double center_length(const float low[3], const float high[3]);

/* Whether bounds of a length, so far away along an axis, are far. */
bool center_is_far(double distance, double length);

/* Whether bounds are far from 0. If so, *center is their middle, rounded so that subtracting it
 * from float32 coordinates there is exact in float32; else it is left alone. */
bool center_find(const float low[3], const float high[3], double center[3]);

#endif
