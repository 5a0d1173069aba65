/* SPDX-License-Identifier: MIT */
#include "app/scene/trace/rays.h"

#include <math.h>

double trace_lift(const scene *world) {
    double size = 0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, fmax(fabs((double)world->minimum[i]), fabs((double)world->maximum[i])));
    return 1e-5 * size;
}

static float largest_of(lmp_vec3 v) {
    const float x = fabsf(v.x), y = fabsf(v.y), z = fabsf(v.z), most = x > y ? x : y;
    return most > z ? most : z;
}

/* Where a ray meets a triangle is a mean of its corners' distances, which rounds off it by up to
 * about 1.5e-7 of their coordinates. Normals and what is modeled ask for more, but only in
 * proportion to how far the point is from the origin. */
float trace_lift_at(float lift, lmp_vec3 point, const lmp_vec3 corners[3]) {
    const float own = 1e-4f * largest_of(point);
    float least = own > lift / 100 ? own : lift / 100;
    for (int i = 0; corners && i < 3; i++) {
        const float far = 1e-6f * largest_of(corners[i]);
        least = far > least ? far : least;
    }
    return least < lift ? least : lift;
}
