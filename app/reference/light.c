/* SPDX-License-Identifier: MIT */
#include "app/reference/light.h"

static reference_source source_of(reference_vec axis, double angle, double one_minus_cos,
                                  lmp_rgb color) {
    return (reference_source) {
        .axis = axis,
        .angle = angle,
        .one_minus_cos = one_minus_cos,
        .solid_angle = 2 * REFERENCE_PI * one_minus_cos,
        .color = { (double)color.r, (double)color.g, (double)color.b },
        .distance = (double)INFINITY,
    };
}

static reference_source sphere_source(const lmp_light *light, reference_vec point, bool grow) {
    const reference_vec to = reference_subtract(reference_from(light->position), point);
    const reference_vec axis = reference_normalize(to);
    const double d = reference_length(to), r = (double)light->radius;
    if (d >= r && d > 0) {
        const double s = r / d;
        return source_of(axis, atan2(r, sqrt((d - r) * (d + r))),
                         s * s / (1 + sqrt((1 - s) * (1 + s))), light->radiance);
    }
    if (grow)
        return source_of(axis, REFERENCE_PI - asin(d / r), 1 + sqrt((r - d) * (r + d)) / r,
                         light->radiance);
    return source_of(axis, REFERENCE_PI, 2, light->radiance);
}

/* KHR_lights_punctual's falloff, whose difference of cosines is held to 1e-3. */
static double spot_falloff(const lmp_light *light, reference_vec from_light) {
    const double outer = cos((double)light->outer), inner = cos((double)light->inner);
    const double cosine = reference_dot(reference_from(light->direction), from_light);
    const double t = fmin(fmax((cosine - outer) / fmax(inner - outer, 1e-3), 0), 1);
    return t * t;
}

static reference_source point_source(const lmp_light *light, reference_vec point) {
    const reference_vec to = reference_subtract(reference_from(light->position), point);
    const reference_vec axis = reference_normalize(to);
    const double d = fmax(reference_length(to), (double)LMP_POINT_DISTANCE_MIN);
    const double falloff =
        light->kind == LMP_LIGHT_SPOT ? spot_falloff(light, reference_scale(-1, axis)) : 1;
    reference_source source = source_of(axis, 0, 0, light->intensity);
    for (int c = 0; c < 3; c++)
        source.color[c] *= falloff / (d * d);
    source.distance = reference_length(to);
    return source;
}

int reference_light_sources(const scene_light *light, reference_vec point, bool grow,
                            reference_source sources[REFERENCE_SOURCES_MAX]) {
    const lmp_light *l = &light->emitter;
    const reference_vec axis = reference_from(l->direction);
    const double half = sin((double)l->angle / 2);
    switch (l->kind) {
    case LMP_LIGHT_SPHERE:
        sources[0] = sphere_source(l, point, grow);
        return 1;
    case LMP_LIGHT_POINT:
    case LMP_LIGHT_SPOT:
        sources[0] = point_source(l, point);
        return 1;
    case LMP_LIGHT_DIRECTIONAL:
        sources[0] = source_of(reference_normalize(axis), 0, 0, l->irradiance);
        return 1;
    case LMP_LIGHT_CAP:
        sources[0] =
            source_of(reference_normalize(axis), (double)l->angle, 2 * half * half, l->radiance);
        return 1;
    case LMP_LIGHT_HEMISPHERE:
        sources[0] = source_of(reference_normalize(axis), REFERENCE_PI / 2, 1, l->radiance);
        sources[1] =
            source_of(reference_scale(-1, sources[0].axis), REFERENCE_PI / 2, 1, l->ground);
        return 2;
    }
    return 0;
}

bool reference_light_is_hit(const scene_light *light, reference_vec point,
                            reference_vec direction) {
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r2 = (double)light->emitter.radius * (double)light->emitter.radius;
    const double d2 = reference_dot(to, to), along = reference_dot(to, direction);
    return d2 < r2 || (along > 0 && d2 - along * along <= r2);
}

double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction) {
    if (light->emitter.kind != LMP_LIGHT_SPHERE)
        return (double)INFINITY;
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r = (double)light->emitter.radius, along = reference_dot(to, direction);
    const double off = reference_length(reference_cross(to, direction));
    const double half = sqrt(fmax((r - off) * (r + off), 0));
    return reference_length(to) < r ? along + half : along - half;
}
