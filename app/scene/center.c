/* SPDX-License-Identifier: MIT */
#include "app/scene/center.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

/* Bounds this many times their length away from 0 are far: more than 6 of float32's 24 bits would
 * tell only where they are. */
#define FAR_RATIO 64.0

/* The spacing of float32 numbers relative to their size, about: no bounds are taken for shorter. */
#define NEIGHBORS 0x1p-22

/* Centers are multiples of a power of two, at least a sixteenth of the bounds' length. */
#define STEP_EXPONENT (-4)

double center_length(const float low[3], const float high[3]) {
    double length = 0.0;
    for (int k = 0; k < 3; k++)
        length = fmax(length, (double)high[k] - (double)low[k]);
    return length;
}

bool center_is_far(double distance, double length) {
    return distance > FAR_RATIO * length && distance <= (double)LMP_LENGTH_MAX;
}

bool center_find(const float low[3], const float high[3], double center[3]) {
    const double length = center_length(low, high);
    double middle[3], distance = 0.0;
    int exponent;
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * ((double)low[k] + (double)high[k]);
        distance = fmax(distance, fabs(middle[k]));
    }
    if (!center_is_far(distance, length))
        return false;
    frexp(fmax(length, NEIGHBORS * distance), &exponent);
    const double step = ldexp(1.0, exponent + STEP_EXPONENT);
    for (int k = 0; k < 3; k++)
        center[k] = step * nearbyint(middle[k] / step) + 0.0; /* no -0 */
    return true;
}
