/* SPDX-License-Identifier: MIT */
#include "app/scene/origin.h"

#include "app/scene/instance.h"

#include <math.h>
#include <string.h>

/* The origin is 0 unless the middle of the scene's bounds is more than so many times their longest
 * side away from it, along an axis: of float32's 24 bits more than 6 would then tell but where the
 * scene is. */
#define FAR_RATIO 64.0

/* As near as two numbers of float32 so far away are to each other, about: bounds are no smaller. */
#define NEIGHBORS 0x1p-22

/* The origin is a multiple of a power of two, which the longest side of the bounds is up to 16
 * times as long as. */
#define STEP_EXPONENT (-4)

/* Where the origin of what lies far away is: the middle of its bounds, rounded so that a coordinate
 * which the file has in float32 differs from it by another float32. False if it is 0. */
static bool choose(const scene_builder *builder, double origin[3]) {
    float low[3], high[3];
    double middle[3], length = 0.0, distance = 0.0;
    int exponent;
    scene world;
    builder_geometry(builder, &world);
    if (!scene_bounds(&world, low, high))
        return false;
    for (int k = 0; k < 3; k++) {
        middle[k] = 0.5 * ((double)low[k] + (double)high[k]);
        length = fmax(length, (double)high[k] - (double)low[k]);
        distance = fmax(distance, fabs(middle[k]));
    }
    if (!(distance > FAR_RATIO * length && distance <= (double)LMP_LENGTH_MAX))
        return false;
    frexp(fmax(length, NEIGHBORS * distance), &exponent);
    const double step = ldexp(1.0, exponent + STEP_EXPONENT);
    for (int k = 0; k < 3; k++)
        origin[k] = step * nearbyint(middle[k] / step) + 0.0; /* no -0 */
    return true;
}

bool origin_read(origin_reader *read, const void *data, size_t size, source_set *sources,
                 scene_builder *builder, cli_error *error) {
    double origin[3];
    if (!read(data, size, sources, builder, error))
        return false;
    if (!choose(builder, origin))
        return true;
    builder_free(builder);
    memcpy(builder->origin, origin, sizeof origin);
    return read(data, size, sources, builder, error);
}
