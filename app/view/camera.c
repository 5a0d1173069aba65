/* SPDX-License-Identifier: MIT */
#include "app/view/camera.h"
#include "app/scene/instance.h"
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
    if (camera->height > 0)
        return (view_ray) { vec_add(f.eye, aside), f.forward, 2 * tall / (float)height, 0 };
    return (view_ray) { f.eye, vec_normalize(vec_add(f.forward, aside), f.forward), 0,
                        2 * tall / (float)height };
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

/* --- picking ---------------------------------------------------------------------------------- */

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

static bool may_hit(const view_ray *ray, const float minimum[3], const float maximum[3],
                    float farthest) {
    const float *from = &ray->from.x, *direction = &ray->direction.x;
    float enter = 0, leave = farthest;
    for (int k = 0; k < 3; k++) {
        const float a = (minimum[k] - from[k]) / direction[k];
        const float b = (maximum[k] - from[k]) / direction[k];
        if (direction[k] == 0) {
            if (from[k] < minimum[k] || from[k] > maximum[k])
                return false;
            continue;
        }
        enter = fmaxf(enter, fminf(a, b));
        leave = fminf(leave, fmaxf(a, b));
    }
    return enter <= leave;
}

/* Returns the distance to a triangle (Möller and Trumbore 1997). */
static float hit_triangle(const view_ray *ray, lmp_vec3 p, lmp_vec3 q, lmp_vec3 r,
                          lmp_vec3 *normal) {
    const lmp_vec3 a = vec_sub(q, p), b = vec_sub(r, p), h = vec_cross(ray->direction, b);
    const float det = vec_dot(a, h);
    const lmp_vec3 from = vec_sub(ray->from, p), s = vec_cross(from, a);
    const float u = vec_dot(from, h) / det, v = vec_dot(ray->direction, s) / det;
    if (det == 0 || !(u >= 0) || !(v >= 0) || !(u + v <= 1))
        return -1;
    *normal = vec_cross(a, b);
    return vec_dot(b, s) / det;
}

view_hit view_pick_surface(const view_ray *ray, const scene *world) {
    view_hit hit = { -1, INFINITY, { 0, 1, 0 } };
    for (size_t i = 0; i < world->instance_count; i++) {
        float minimum[3], maximum[3], p[3][3];
        scene_instance_box(world, i, minimum, maximum);
        if (!may_hit(ray, minimum, maximum, hit.distance))
            continue;
        for (uint32_t t = 0; t < scene_instance_triangles(world, i); t++) {
            lmp_vec3 normal;
            scene_triangle_positions(world, i, t, p);
            const float distance =
                hit_triangle(ray, vec_load(p[0]), vec_load(p[1]), vec_load(p[2]), &normal);
            if (distance > 0 && distance < hit.distance)
                hit = (view_hit) { (int)world->instances[i].mesh, distance, normal };
        }
    }
    hit.normal = vec_normalize(hit.normal, vec(0, 1, 0));
    if (vec_dot(hit.normal, ray->direction) > 0)
        hit.normal = vec_scale(hit.normal, -1);
    return hit;
}
