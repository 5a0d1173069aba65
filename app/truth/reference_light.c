/* SPDX-License-Identifier: MIT */
#include "app/truth/reference_light.h"

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

/* Evaluates KHR_lights_punctual's falloff, whose difference of cosines is at least 1e-3. */
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

static reference_area area_of(const lmp_light *light) {
    reference_area area = { .position = reference_from(light->position),
                            .two_sided = light->two_sided,
                            .radius = (double)light->radius };
    const reference_vec x = reference_from(light->half[0]), y = reference_from(light->half[1]);
    area.tube = light->kind == LMP_LIGHT_TUBE;
    area.disk = light->kind == LMP_LIGHT_DISK;
    area.whole = light->kind == LMP_LIGHT_RECTANGLE;
    area.axis = area.disk ? reference_from(light->direction) : x;
    if (area.whole) {
        area.count = 4;
        area.corner[0] = reference_scale(-1, reference_add(x, y));
        area.corner[1] = reference_subtract(x, y);
        area.corner[2] = reference_add(x, y);
        area.corner[3] = reference_subtract(y, x);
    } else if (light->kind == LMP_LIGHT_POLYGON) {
        area.count = light->corner_count;
        for (int i = 0; i < area.count; i++)
            area.corner[i] = reference_from(light->corner[i]);
    }
    return area;
}

static reference_area_hit meet_area(const lmp_light *light, reference_vec point,
                                    reference_vec direction) {
    const reference_area area = area_of(light);
    return reference_area_meet(&area, point, direction);
}

/* An area that surrounds the point shines from everywhere; with `grow` it is the sphere around the
 * nearest point of the axis. */
static reference_source inside_source(const lmp_light *tube, const reference_area_view *view,
                                      bool grow) {
    const reference_vec origin = { 0, 0, 0 }, at = view->nearest;
    const lmp_light sphere = { .position = { (float)at.x, (float)at.y, (float)at.z },
                               .radius = tube->radius,
                               .radiance = tube->radiance };
    return sphere_source(&sphere, origin, grow);
}

static int area_source(const lmp_light *light, reference_vec point, bool grow,
                       reference_source *source) {
    const reference_area area = area_of(light);
    const reference_area_view view = reference_area_see(&area, point);
    const double d = reference_length(view.center), r = view.radius;
    if (!view.shines)
        return 0;
    if (view.inside) {
        *source = inside_source(light, &view, grow);
        return 1;
    }
    const double angle = d > r ? asin(r / d) : REFERENCE_PI;
    const double half = sin(angle / 2);
    *source = source_of(reference_normalize(view.center), angle, 2 * half * half, light->radiance);
    source->solid_angle = fmin(source->solid_angle, view.solid_angle);
    source->is_area = true;
    source->area = area;
    return source->solid_angle > 0;
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
    case LMP_LIGHT_RECTANGLE:
    case LMP_LIGHT_DISK:
    case LMP_LIGHT_TUBE:
    case LMP_LIGHT_POLYGON:
        return area_source(l, point, grow, sources);
    }
    return 0;
}

bool reference_light_is_hit(const scene_light *light, reference_vec point,
                            reference_vec direction) {
    if (scene_light_is_area(&light->emitter))
        return isfinite(meet_area(&light->emitter, point, direction).distance);
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r2 = (double)light->emitter.radius * (double)light->emitter.radius;
    const double d2 = reference_dot(to, to), along = reference_dot(to, direction);
    return d2 < r2 || (along > 0 && d2 - along * along <= r2);
}

double reference_light_distance(const scene_light *light, reference_vec point,
                                reference_vec direction) {
    if (scene_light_is_area(&light->emitter))
        return meet_area(&light->emitter, point, direction).distance;
    if (light->emitter.kind != LMP_LIGHT_SPHERE)
        return (double)INFINITY;
    const reference_vec to = reference_subtract(reference_from(light->emitter.position), point);
    const double r = (double)light->emitter.radius, along = reference_dot(to, direction);
    const double off = reference_length(reference_cross(to, direction));
    const double half = sqrt(fmax((r - off) * (r + off), 0));
    return reference_length(to) < r ? along + half : along - half;
}
