/* SPDX-License-Identifier: MIT */
#include "app/reference/light.h"

reference_cap reference_cap_of(const scene_light *light, reference_vec point, bool grow) {
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double d = reference_length(to), r = (double)light->emitter.radius;
    reference_cap cap = { .axis = reference_normalize(to),
                          .angle = REFERENCE_PI,
                          .one_minus_cos = 2 };
    if (d >= r && d > 0) {
        const double s = r / d;
        cap.angle = atan2(r, sqrt((d - r) * (d + r)));
        cap.one_minus_cos = s * s / (1 + sqrt((1 - s) * (1 + s)));
    } else if (grow) {
        cap.angle = REFERENCE_PI - asin(d / r);
        cap.one_minus_cos = 1 + sqrt((r - d) * (r + d)) / r;
    }
    cap.solid_angle = 2 * REFERENCE_PI * cap.one_minus_cos;
    return cap;
}

bool reference_light_is_hit(const scene_light *light, reference_vec point,
                            reference_vec direction) {
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r2 = (double)light->emitter.radius * (double)light->emitter.radius,
                 d2 = reference_dot(to, to);
    const double along = reference_dot(to, direction);
    return d2 < r2 || (along > 0 && d2 - along * along <= r2);
}

double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction) {
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r = (double)light->emitter.radius, along = reference_dot(to, direction);
    const double off = reference_length(reference_cross(to, direction));
    const double half = sqrt(fmax((r - off) * (r + off), 0));
    return reference_length(to) < r ? along + half : along - half;
}
