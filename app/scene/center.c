/* SPDX-License-Identifier: MIT */
#include "app/scene/center.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

/* What is more than so many times its length away from 0 is far: of float32's 24 bits more than 6
 * would then tell but where it is. */
#define FAR_RATIO 64.0

/* As near as two numbers of float32 so far away are to each other, about: no bounds are shorter. */
#define NEIGHBORS 0x1p-22

/* A center is a multiple of a power of two that the bounds are up to 16 times as long as. */
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
