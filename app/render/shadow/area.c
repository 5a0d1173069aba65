/* SPDX-License-Identifier: MIT */
#include "app/render/shadow/area.h"

#include "app/render/shadow/turn.h"

/* Rays end by this part of their length before a light, so that the mesh that it stands for is not
 * hit. */
static const float before_light = 1e-4f;

/* --- how much arrives ------------------------------------------------------------------------- */

/* The irradiance of a disk of this area at its axis, as seen under an angle of that cosine. */
static float power_of(float facing, float cosine, float distance2) {
    return facing * cosine / (facing + PI * distance2);
}

/* A flat area is taken for a disk around all of it, to whose nearest point the distance is. */
static float power_of_flat(const scene_emitter *area, lmp_vec3 to) {
    const float above = -vec_dot(to, area->normal);
    const float height = area->two_sided ? fabsf(above) : above;
    const float beside2 = vec_dot(to, to) - height * height;
    const float beside = beside2 > 0 ? sqrtf(beside2) : 0;
    const float gap = beside > area->extent ? beside - area->extent : 0;
    const float near2 = height * height + gap * gap;
    return height > 0 ? power_of(area->facing, height / sqrtf(near2), near2) : 0;
}

/* The solid angle of a thin cylinder is 2r/b (sin e - sin s): b the distance of its axis, e and s
 * the angles to its ends from there. A round end is added, which is all of it seen from beyond one.
 */
static float power_of_tube(const scene_emitter *tube, lmp_vec3 to) {
    const float middle = vec_dot(to, tube->normal), half = tube->half,
                r2 = tube->radius * tube->radius;
    const float beside2 = fmaxf(vec_dot(to, to) - middle * middle, r2);
    const float start = middle - half, end = middle + half;
    const float start2 = start * start + beside2, end2 = end * end + beside2;
    const float side =
        2 * tube->radius / sqrtf(beside2) * (end / sqrtf(end2) - start / sqrtf(start2));
    const float solid_angle = side + PI * r2 / fminf(start2, end2);
    return fminf(solid_angle / PI, 1);
}

float shadow_area_power(const scene_emitter *area, lmp_vec3 to) {
    return area->form == SCENE_EMITTER_TUBE ? power_of_tube(area, to) : power_of_flat(area, to);
}

/* --- points ----------------------------------------------------------------------------------- */

/* A point of the light, its unit normal, and the surface that it stands for. */
typedef struct area_point {
    lmp_vec3 at, normal;
    float surface;
} area_point;

static area_point point_of_flat(const scene_emitter *area, float u, float v) {
    const bool round = area->form == SCENE_EMITTER_DISK;
    float x = 2 * u - 1, y = 2 * v - 1;
    if (round) {
        const float radius = sqrtf(u);
        float sine, cosine;
        shadow_sine_cosine(v, &sine, &cosine);
        x = radius * cosine;
        y = radius * sine;
    }
    const lmp_vec3 off = vec_add(vec_scale(area->x, x), vec_scale(area->y, y));
    const bool covered = round || scene_emitter_covers(area, x, y);
    return (area_point) { vec_add(area->center, off), area->normal, covered ? area->surface : 0 };
}

/* Equal lengths of a tube's axis, its round ends included, have equal surfaces. Beside the axis
 * only the half that is toward the viewer can be seen. */
static area_point point_of_tube(const scene_emitter *tube, lmp_vec3 to, float u, float v) {
    const float length = 2 * (tube->half + tube->radius), s = (u - 0.5f) * length;
    const float past = fabsf(s) - tube->half, r = tube->radius;
    const lmp_vec3 back = vec_sub(vec_scale(tube->normal, vec_dot(to, tube->normal)), to);
    const lmp_vec3 toward = vec_normalize(back, vec_across(tube->normal));
    const lmp_vec3 across = vec_cross(tube->normal, toward);
    const bool beside = !(past > 0);
    float sine, cosine, ring = 1, rise = 0;
    shadow_sine_cosine(beside ? 0.5f * v : v, &sine, &cosine);
    if (!beside) {
        const float in_radii = past < r ? past / r : 1;
        rise = s > 0 ? in_radii : -in_radii;
        ring = sqrtf((1 - in_radii) * (1 + in_radii));
    }
    const lmp_vec3 out = vec_add(vec_scale(toward, sine), vec_scale(across, cosine));
    const lmp_vec3 normal = vec_add(vec_scale(out, ring), vec_scale(tube->normal, rise));
    const lmp_vec3 at =
        vec_add(tube->center, vec_add(vec_scale(tube->normal, s), vec_scale(out, ring * r)));
    return (area_point) { at, normal, (beside ? PI : 2 * PI) * r * length };
}

shadow_area_sample shadow_area_draw(const scene_emitter *area, lmp_vec3 from, float u, float v) {
    const lmp_vec3 to = vec_sub(area->center, from);
    const area_point point = area->form == SCENE_EMITTER_TUBE ? point_of_tube(area, to, u, v)
                                                              : point_of_flat(area, u, v);
    const lmp_vec3 way = vec_sub(point.at, from);
    const float least = LMP_POINT_DISTANCE_MIN * LMP_POINT_DISTANCE_MIN;
    const float d2 = fmaxf(vec_dot(way, way), least), d = sqrtf(d2);
    const lmp_vec3 direction = vec_scale(way, 1 / d);
    const float turned = -vec_dot(direction, point.normal);
    const float cosine = area->two_sided ? fabsf(turned) : fmaxf(turned, 0);
    const float center2 = vec_dot(to, to), extent = area->extent;
    return (shadow_area_sample) {
        .direction = direction,
        .length = d * (1 - before_light),
        .size = center2 > extent * extent ? extent / sqrtf(center2) : 1,
        .solid_angle = point.surface * cosine / d2,
    };
}
