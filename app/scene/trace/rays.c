/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/rays.h"

#include <math.h>

double trace_lift(const scene *world) {
    double size = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs((double)world->minimum[i]), fabs((double)world->maximum[i])));
    return 1e-5 * size;
}
