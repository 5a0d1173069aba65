/* SPDX-License-Identifier: MIT */
#include "app/view/camera.h"
#include "app/scene/vector.h"

#include <math.h>

#define STEEPEST 1.55f /* elevation limit, nearly straight up or down */

typedef struct frame {
    lmp_vec3 eye, right, up, forward;
    float distance; /* to the target */
} frame;

static frame frame_of(const scene_camera *camera) {
    const lmp_vec3 eye = vec_load(camera->eye), way = vec_sub(vec_load(camera->target), eye);
    const lmp_vec3 forward = vec_normalize(way, vec(0, 0, -1));
    const lmp_vec3 right =
        vec_normalize(vec_cross(forward, vec_load(camera->up)), vec_across(forward));
    return (frame) { eye, right, vec_cross(right, forward), forward, vec_length(way) };
}

/* Rotates a direction to the right and up, with y staying up. */
static lmp_vec3 rotated(lmp_vec3 direction, float right, float up) {
    const float heading = atan2f(direction.x, -direction.z) + right;
    const float height = asinf(fminf(fmaxf(direction.y, -1), 1)) + up;
    const float held = fminf(fmaxf(height, -STEEPEST), STEEPEST);
    return vec(cosf(held) * sinf(heading), sinf(held), -cosf(held) * cosf(heading));
}

static void stand_upright(scene_camera *camera) {
    vec_store(vec(0, 1, 0), camera->up);
}

void view_orbit(scene_camera *camera, float right, float up) {
    const frame f = frame_of(camera);
    const lmp_vec3 forward = rotated(f.forward, -right, -up);
    stand_upright(camera);
    vec_store(vec_sub(vec_load(camera->target), vec_scale(forward, f.distance)), camera->eye);
}

void view_look_round(scene_camera *camera, float right, float up) {
    const frame f = frame_of(camera);
    stand_upright(camera);
    vec_store(vec_add(f.eye, vec_scale(rotated(f.forward, right, up), f.distance)), camera->target);
}

static void move(scene_camera *camera, lmp_vec3 by) {
    vec_store(vec_add(vec_load(camera->eye), by), camera->eye);
    vec_store(vec_add(vec_load(camera->target), by), camera->target);
}

void view_pan(scene_camera *camera, float right, float up) {
    const frame f = frame_of(camera);
    const float height = scene_camera_height(camera, f.distance);
    move(camera, vec_add(vec_scale(f.right, right * height), vec_scale(f.up, up * height)));
}

bool view_camera_is_valid(const scene_camera *camera) {
    bool valid = camera->height <= LMP_LENGTH_MAX;
    for (int i = 0; i < 3; i++)
        valid &=
            fabsf(camera->eye[i]) <= LMP_LENGTH_MAX && fabsf(camera->target[i]) <= LMP_LENGTH_MAX;
    return valid;
}

void view_dolly(scene_camera *camera, float factor, float nearest) {
    if (camera->height > 0) {
        camera->height = fminf(fmaxf(camera->height * factor, nearest), 0.1f * LMP_LENGTH_MAX);
        return;
    }
    const frame f = frame_of(camera);
    if (!(f.distance * factor <= 0.1f * LMP_LENGTH_MAX))
        return;
    const float distance = fmaxf(f.distance * factor, nearest);
    const lmp_vec3 eye = vec_add(f.eye, vec_scale(f.forward, f.distance * (1 - factor)));
    vec_store(eye, camera->eye);
    vec_store(vec_add(eye, vec_scale(f.forward, distance)), camera->target);
}

void view_fly(scene_camera *camera, float right, float up, float forward) {
    const frame f = frame_of(camera);
    move(camera,
         vec_add(vec_add(vec_scale(f.right, right), vec_scale(f.forward, forward)), vec(0, up, 0)));
}

void view_frame(scene_camera *camera, lmp_vec3 center, float radius, float aspect) {
    const frame f = frame_of(camera);
    const float half_angle = atanf(tanf(0.5f * camera->fov) * fminf(aspect, 1));
    const float distance = fmaxf(radius, 1e-6f) / sinf(half_angle);
    if (camera->height > 0)
        camera->height = 2 * fmaxf(radius, 1e-6f) / fminf(aspect, 1);
    vec_store(center, camera->target);
    vec_store(vec_sub(center, vec_scale(f.forward, distance)), camera->eye);
}

/* --- rays ------------------------------------------------------------------------------------- */

view_ray view_ray_through(const scene_camera *camera, int width, int height, double x, double y) {
    const frame f = frame_of(camera);
    const float tall = 0.5f * scene_camera_height(camera, 1),
                wide = tall * (float)width / (float)height;
    const float right = wide * (float)(2 * x / width - 1), up = tall * (float)(1 - 2 * y / height);
    const lmp_vec3 aside = vec_add(vec_scale(f.right, right), vec_scale(f.up, up));
    const float stretch = camera->height > 0 ? 1 : vec_length(vec_add(f.forward, aside));
    const float near = stretch * camera->near,
                far = camera->far > 0 ? stretch * camera->far : INFINITY;
    const float pixel = 2 * tall / (float)height;
    if (camera->height > 0)
        return (view_ray) { vec_add(f.eye, aside), f.forward, near, far, pixel, 0 };
    return (view_ray) { f.eye, vec_normalize(vec_add(f.forward, aside), f.forward), near, far, 0,
                        pixel };
}

bool view_project(const scene_camera *camera, int width, int height, lmp_vec3 point, double *x,
                  double *y, double *scale) {
    const frame f = frame_of(camera);
    const lmp_vec3 way = vec_sub(point, f.eye);
    const float depth = vec_dot(way, f.forward);
    if (!(depth > 0))
        return false;
    *scale = height / (double)scene_camera_height(camera, depth);
    *x = 0.5 * width + (double)vec_dot(way, f.right) * *scale;
    *y = 0.5 * height - (double)vec_dot(way, f.up) * *scale;
    return true;
}

int view_pick_light(const view_ray *ray, const scene_light *lights, size_t count, float pixels,
                    float *distance) {
    int nearest = -1;
    for (size_t i = 0; i < count; i++) {
        if (!scene_light_has(&lights[i], SCENE_LIGHT_POSITION))
            continue;
        const lmp_vec3 way = vec_sub(lights[i].emitter.position, ray->from);
        const float along = vec_dot(way, ray->direction);
        const lmp_vec3 miss = vec_sub(way, vec_scale(ray->direction, along));
        const float extent = scene_light_extent(&lights[i].emitter);
        const float reach = extent + pixels * (ray->pixel + ray->spread * along);
        /* not the light that the eye is inside of, which would catch every ray */
        if (!(along > 0) || vec_length(way) <= extent || !(vec_dot(miss, miss) <= reach * reach))
            continue;
        if (nearest < 0 || along < *distance) {
            nearest = (int)i;
            *distance = along;
        }
    }
    return nearest;
}
