/* SPDX-License-Identifier: MIT */
/* The camera of a scene that brings none: before a model, inside a building. */
#include "app/scene/scene.h"
#include "app/scene/space.h"
#include "app/scene/vector.h"

#define DEFAULT_FOV   0.7854f /* 45° */
#define INSIDE_FOV    1.2f    /* wide, as one sees rooms */
#define INSIDE_BACK   0.8f    /* of the way to the wall behind */
#define INSIDE_HEIGHT 0.4f    /* of a room's height */
#define FRAMING_PART  0.9f    /* of the image that an automatic camera fills at most */

/* Looks to the middle of a building, from where there is most room. */
static scene_camera camera_inside(lmp_vec3 middle, const space_room *room) {
    scene_camera camera = { .name = "inside", .up = { 0.0f, 1.0f, 0.0f }, .fov = INSIDE_FOV };
    float most = 0.0f;
    lmp_vec3 way = vec(0.0f, 0.0f, 1.0f);
    for (int axis = 0; axis < 3; axis += 2)
        for (int sign = -1; sign <= 1; sign += 2) {
            const float free = sign < 0 ? room->back[axis] : room->ahead[axis];
            if (isfinite(free) && free > most) {
                most = free;
                way = axis == 0 ? vec((float)sign, 0.0f, 0.0f) : vec(0.0f, 0.0f, (float)sign);
            }
        }
    if (isfinite(room->back[1]) && isfinite(room->ahead[1]))
        middle.y += INSIDE_HEIGHT * (room->back[1] + room->ahead[1]) - room->back[1];
    vec_store(vec_add(middle, vec_scale(way, INSIDE_BACK * most)), camera.eye);
    vec_store(middle, camera.target);
    return camera;
}

/* From how far away in the direction `from` every triangle fits into the image. */
static float framing_distance(const scene *s, lmp_vec3 center, lmp_vec3 from, float aspect) {
    const lmp_vec3 right = vec_normalize(vec_cross(vec(0.0f, 1.0f, 0.0f), from), from);
    const lmp_vec3 up = vec_cross(from, right);
    const float slope = FRAMING_PART * tanf(0.5f * DEFAULT_FOV);
    float radius = 1e-6f, distance = 0.0f;
    for (size_t i = 0; i < s->index_count; i++) {
        const lmp_vec3 p = vec_sub(vec_load(s->vertices[s->indices[i]].position), center);
        const float side = fmaxf(fabsf(vec_dot(right, p)) / aspect, fabsf(vec_dot(up, p)));
        distance = fmaxf(distance, side / slope + vec_dot(from, p));
        radius = fmaxf(radius, vec_length(p));
    }
    /* nor may the camera stand inside */
    return fmaxf(distance, radius);
}

float scene_camera_height(const scene_camera *camera, float distance) {
    return camera->height > 0.0f ? camera->height : 2.0f * distance * tanf(0.5f * camera->fov);
}

/* Narrower images see more above and below. */
static void widen(scene_camera *camera, float aspect) {
    if (!(aspect > 0.0f && aspect < camera->aspect))
        return;
    camera->height *= camera->aspect / aspect;
    camera->fov = 2.0f * atanf(tanf(0.5f * camera->fov) * camera->aspect / aspect);
}

scene_camera scene_default_camera(const scene *s, float aspect) {
    if (s->camera_count > 0) {
        scene_camera first = s->cameras[0];
        widen(&first, aspect);
        return first;
    }
    const lmp_vec3 lo = vec_load(s->minimum), hi = vec_load(s->maximum);
    const lmp_vec3 center = vec_add(vec_scale(lo, 0.5f), vec_scale(hi, 0.5f));
    const lmp_vec3 from = vec_normalize(vec(0.45f, 0.35f, 1.0f), vec(0.0f, 0.0f, 1.0f));
    space_room room;
    if (space_is_building(s, center, &room))
        return camera_inside(center, &room);
    const float distance = framing_distance(s, center, from, aspect > 0.0f ? aspect : 1.0f);
    scene_camera camera = { .name = "framed", .up = { 0.0f, 1.0f, 0.0f }, .fov = DEFAULT_FOV };
    vec_store(center, camera.target);
    vec_store(vec_add(center, vec_scale(from, distance)), camera.eye);
    return camera;
}
