/* SPDX-License-Identifier: MIT */
#include "app/scene/builtin/builtin.h"
#include "app/scene/grid.h"
#include "app/scene/instance.h"
#include "app/scene/random.h"
#include "app/scene/scene.h"
#include "app/scene/space.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* Random lights: radii relative to the scene's size, and the mean irradiance (a white light spread
 * over the scene's bounding sphere) that their powers sum to. */
#define RANDOM_RADIUS_SMALL  0.008f
#define RANDOM_RADIUS_LARGE  0.020f
#define RANDOM_IRRADIANCE    12.0f
#define RANDOM_MARGIN        0.08f /* fraction of a building's bounds that stays free at each side */
#define RANDOM_AROUND        0.35f /* fraction of the size added to other bounds, except below */
#define RANDOM_SEEN          0.07f /* largest ratio of radius to distance from the camera */
#define RANDOM_ATTEMPTS      64    /* to find free space for a light */
#define RANDOM_WARM_FRACTION 0.5f
#define RANDOM_ASPECT        1.5f
#define RANDOM_LOOKS         512
#define RANDOM_SEEN_LEAST    0.05f /* of the box, at least: visible, or lights move into view */

void scene_clear_lights(scene *s) {
    s->light_count = 0;
    s->motion_count = 0;
}

lmp_rgb builtin_light_color(uint64_t *random, float warm_fraction) {
    static const lmp_rgb saturated[] = {
        { 0.08f, 0.55f, 1.0f }, { 1.0f, 0.10f, 0.32f }, { 0.10f, 1.0f, 0.55f },
        { 0.62f, 0.16f, 1.0f }, { 1.0f, 0.32f, 0.05f }, { 0.05f, 0.90f, 1.0f },
    };
    const float pick = random_unit(random), shade = random_unit(random);
    if (pick < warm_fraction)
        return (lmp_rgb) { 1.0f, 0.44f + 0.18f * shade, 0.10f + 0.20f * shade };
    const int count = (int)(sizeof saturated / sizeof *saturated);
    int hue = (int)((pick - warm_fraction) / (1.0f - warm_fraction) * (float)count);
    hue = hue < count ? hue : count - 1;
    const lmp_rgb pure = saturated[hue];
    return (lmp_rgb) { pure.r + (1.0f - pure.r) * 0.12f * shade,
                       pure.g + (1.0f - pure.g) * 0.12f * shade,
                       pure.b + (1.0f - pure.b) * 0.12f * shade };
}

/* The box of random lights: inside a building, else around and above the model. */
typedef struct random_box {
    float lo[3], hi[3];
    float size; /* lights are sized relative to it */
} random_box;

static lmp_vec3 position_in(const random_box *box, uint64_t *random) {
    float position[3];
    for (int k = 0; k < 3; k++)
        position[k] = random_between(random, box->lo[k], box->hi[k]);
    return vec_load(position);
}

/* Returns the direction from the camera's eye through a point of the image, -1 … 1 along each axis;
 * its length along the view is 1. */
static lmp_vec3 way_through(const scene_camera *camera, float x, float y) {
    const lmp_vec3 forward = vec_normalize(vec_sub(vec_load(camera->target), vec_load(camera->eye)),
                                           vec(0.0f, 0.0f, -1.0f)),
                   right =
                       vec_normalize(vec_cross(forward, vec_load(camera->up)), vec_across(forward)),
                   up = vec_cross(right, forward);
    const float slope = (float)tan(0.5 * (double)camera->fov);
    return vec_add(forward,
                   vec_add(vec_scale(right, RANDOM_ASPECT * slope * x), vec_scale(up, slope * y)));
}

/* Whether a point is in the image and nothing hides it. */
static bool is_seen(const scene_grid *grid, const scene_camera *camera, lmp_vec3 point) {
    const lmp_vec3 eye = vec_load(camera->eye), way = vec_sub(point, eye),
                   corner = way_through(camera, 1.0f, 1.0f),
                   forward = way_through(camera, 0.0f, 0.0f);
    const float depth = vec_dot(way, forward), across = vec_dot(way, way) - depth * depth,
                widest = vec_dot(corner, corner) - 1.0f;
    float distance;
    if (!(depth > 0.0f && across < widest * depth * depth))
        return false;
    return scene_grid_look(grid, eye, way, &distance) == GRID_NOTHING || distance >= 1.0f;
}

/* Returns the part of the box that the camera sees, from near its eye to the end of its view. */
static random_box box_seen(const scene_grid *grid, const scene_camera *camera,
                           const random_box *box, uint64_t random) {
    const lmp_vec3 eye = vec_load(camera->eye);
    random_box seen = { .lo = { INFINITY, INFINITY, INFINITY },
                        .hi = { -INFINITY, -INFINITY, -INFINITY } };
    for (int i = 0; i < RANDOM_LOOKS; i++) {
        const float x = random_between(&random, -0.8f, 0.8f),
                    y = random_between(&random, -0.5f, 0.8f);
        const lmp_vec3 way = way_through(camera, x, y);
        float distance;
        if (scene_grid_look(grid, eye, way, &distance) == GRID_NOTHING)
            continue;
        float at[3];
        vec_store(vec_add(eye, vec_scale(way, random_between(&random, 0.3f, 0.8f) * distance)), at);
        for (int k = 0; k < 3; k++) {
            seen.lo[k] = fmaxf(fminf(seen.lo[k], at[k]), box->lo[k]);
            seen.hi[k] = fminf(fmaxf(seen.hi[k], at[k]), box->hi[k]);
        }
    }
    seen.size = vec_length(vec_sub(vec_load(seen.hi), vec_load(seen.lo)));
    return seen;
}

/* Narrows the box to the camera's view if the camera sees only a small part of a large scene. */
static void see_box(const scene *s, random_box *box) {
    const scene_camera camera = scene_default_camera(s, RANDOM_ASPECT);
    scene_grid *grid = camera.height > 0.0f ? NULL : scene_grid_create(s);
    int seen = 0;
    uint64_t random = 1;
    if (!grid)
        return;
    for (int i = 0; i < RANDOM_LOOKS; i++)
        seen += is_seen(grid, &camera, position_in(box, &random));
    if ((float)seen < RANDOM_SEEN_LEAST * RANDOM_LOOKS) {
        const random_box view = box_seen(grid, &camera, box, random);
        if (view.lo[0] < view.hi[0] && view.lo[1] < view.hi[1] && view.lo[2] < view.hi[2])
            *box = view;
    }
    scene_grid_destroy(grid);
}

static random_box box_of(const scene *s) {
    const bool building = scene_is_inside(s);
    const float around = RANDOM_AROUND * scene_diagonal(s);
    random_box box = { .size = scene_diagonal(s) };
    for (int k = 0; k < 3; k++) {
        const float extent = s->maximum[k] - s->minimum[k];
        box.lo[k] = s->minimum[k] + (building ? RANDOM_MARGIN * extent : k == 1 ? 0.0f : -around);
        box.hi[k] = s->maximum[k] + (building ? -RANDOM_MARGIN * extent : around);
    }
    see_box(s, &box);
    return box;
}

/* Draws new positions for lights that intersect triangles or fill the view; where there is no room,
 * lights go above everything. Each light has its own random stream, so that no light affects
 * another. */
static bool make_room(scene *s, size_t first, const random_box *box, uint64_t seed) {
    const lmp_vec3 eye = vec_load(scene_default_camera(s, 1.5f).eye);
    size_t count = s->light_count - first, above = 0;
    space_ball *balls = malloc((count + 1) * sizeof *balls);
    for (size_t i = 0; balls && i < count; i++)
        balls[i].number = first + i;
    for (uint64_t attempt = 1; balls && count; attempt++) {
        for (size_t i = 0; i < count; i++) {
            const lmp_light *light = &s->lights[balls[i].number].emitter;
            balls[i].center = light->position;
            balls[i].radius = light->radius;
        }
        space_fit(s, balls, count);
        size_t misfits = 0;
        for (size_t i = 0; i < count; i++) {
            const space_ball ball = balls[i];
            lmp_vec3 *position = &s->lights[ball.number].emitter.position;
            uint64_t random = seed ^ ((uint64_t)ball.number << 32 | attempt);
            if (ball.fits && ball.radius < RANDOM_SEEN * vec_length(vec_sub(ball.center, eye)))
                continue;
            *position = position_in(box, &random);
            if (attempt < RANDOM_ATTEMPTS)
                balls[misfits++] = ball;
            else {
                position->y = s->maximum[1] + 2.0f * ball.radius;
                above++;
            }
        }
        count = misfits;
    }
    if (above > 0 && scene_is_inside(s))
        base_note(s->name, "no room inside for %zu of the random lights: they are above everything",
                  above);
    free(balls);
    return balls;
}

bool scene_add_random_lights(scene *s, int count, uint64_t seed, base_error *error) {
    if (count < 0 || (size_t)count > SCENE_LIGHTS_MAX - s->light_count)
        return base_fail(error, s->name, "would have %zu lights (at most %d)",
                         s->light_count + (size_t)count, SCENE_LIGHTS_MAX);
    const size_t first = s->light_count;
    const random_box box = box_of(s);
    const float size = box.size;
    uint64_t random = seed;
    for (int i = 0; i < count; i++) {
        /* many lights are smaller, so that a thousand still leave room */
        const float crowd = fminf(1.0f, sqrtf(30.0f / (float)count));
        const float radius =
            size * crowd * random_between(&random, RANDOM_RADIUS_SMALL, RANDOM_RADIUS_LARGE);
        const lmp_vec3 position = position_in(&box, &random);
        const lmp_rgb color = builtin_light_color(&random, RANDOM_WARM_FRACTION);
        /* the power that gives the bounding sphere its irradiance, divided among the lights */
        const float power = RANDOM_IRRADIANCE * PI * size * size / (float)count;
        scene_light *light = &s->lights[s->light_count];
        light->emitter = (lmp_light) { .position = position, .radius = radius };
        if (radius > 0.0f)
            light->emitter.radiance =
                rgb_scale(color, lmp_sphere_radiance_from_power(power, radius));
        scene_light_error wrong;
        if (!scene_light_check(light, &wrong)) {
            s->light_count = first;
            return base_fail(error, s->name, "is too small or too large for random lights: %s",
                             wrong.text + (wrong.text[0] == '.'));
        }
        s->light_count++;
    }
    return make_room(s, first, &box, seed) || base_fail(error, s->name, "does not fit into memory");
}
