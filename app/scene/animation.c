/* SPDX-License-Identifier: MIT */
#include "app/scene/animation.h"

#include "app/base/choice.h"
#include "app/scene/animation_path.h"
#include "app/scene/random.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

/* The slowest period of orbits and bounces, after which all lights are back. */
#define PERIOD 8.0

/* The size of an orbit relative to the scene's. */
#define ORBIT_SIZE 0.04f

/* Seconds of a fall through the whole height of the scene and the way back. */
#define BOUNCE_PERIOD 2.0

struct animation {
    float minimum[3], maximum[3]; /* the scene's bounds */
    path rest;                    /* of lights without a path of their own */
    path *paths;
    size_t path_count;
};

/* --- the paths -------------------------------------------------------------------------------- */

static void orbit(const animation *all, size_t number, double seconds, scene_light *light) {
    const float size = vec_length(vec_sub(vec_load(all->maximum), vec_load(all->minimum)));
    uint64_t random = 0x6c616d70 + number;
    float center[3];
    vec_store(light->emitter.position, center);
    for (int k = 0; k < 3; k++) {
        /* Whole multiples of one frequency, so that every orbit closes after PERIOD. */
        const double cycles = 1.0 + (double)(random_bits(&random) % 3);
        const double phase = 2.0 * (double)PI * (double)random_unit(&random);
        const double angle = 2.0 * (double)PI * cycles * seconds / PERIOD;
        const float rest = center[k];
        /* A light that rests inside the bounds stays inside them. */
        const float room = fminf(rest - all->minimum[k], all->maximum[k] - rest);
        const float reach =
            fmaxf(0.0f, fminf(ORBIT_SIZE * size, room - scene_light_extent(&light->emitter)));
        center[k] = rest + 0.5f * reach * (float)(sin(angle + phase) - sin(phase));
    }
    light->emitter.position = vec_load(center);
}

/* Lets a light fall from its resting position to the bottom and rise again, along parabolas of the
 * same height. */
static void bounce(double bottom, double period, double seconds, scene_light *light) {
    const double top = (double)light->emitter.position.y;
    const double height = top - (double)scene_light_extent(&light->emitter) - bottom;
    const double fall = 1.0 - fabs(2.0 * fmod(seconds, period) / period - 1.0);
    if (height > 0.0)
        light->emitter.position.y = (float)(top - height * fall * fall);
}

/* Returns the period of a bounce, an integer fraction of PERIOD: a fall takes longer by the square
 * root of its height. */
static double bounce_period(const animation *all, const scene_light *light) {
    const double whole = (double)all->maximum[1] - (double)all->minimum[1];
    const double height = (double)light->emitter.position.y -
                          (double)scene_light_extent(&light->emitter) - (double)all->minimum[1];
    if (!(whole > 0.0) || !(height > 0.0))
        return PERIOD;
    const double count = floor(PERIOD / (BOUNCE_PERIOD * sqrt(height / whole)) + 0.5);
    return PERIOD / (count < 1.0 ? 1.0 : count > 64.0 ? 64.0 : count);
}

/* Rotates v around the axis through `center`, counter-clockwise as seen from its tip
 * (Rodrigues). */
static lmp_vec3 rotate_around(const double axis[3], const double center[3], double angle,
                              lmp_vec3 v) {
    const double c = cos(angle), s = sin(angle);
    const double from[3] = { (double)v.x - center[0], (double)v.y - center[1],
                             (double)v.z - center[2] };
    const double along = from[0] * axis[0] + from[1] * axis[1] + from[2] * axis[2];
    float to[3];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        const double across = axis[i] * from[j] - axis[j] * from[i];
        to[k] = (float)(center[k] + from[k] * c + across * s + axis[k] * along * (1.0 - c));
    }
    return vec_load(to);
}

/* A rotation of directions. */
typedef struct rotation {
    const double *axis;
    double angle;
} rotation;

static lmp_vec3 rotate(lmp_vec3 v, const void *user) {
    static const double origin[3] = { 0.0, 0.0, 0.0 };
    const rotation *r = user;
    return rotate_around(r->axis, origin, r->angle, v);
}

/* Moves a light along a circle; it rotates as it goes, so that a sun goes around the sky. */
static void circle(const path *p, double seconds, scene_light *light) {
    const double angle = 2.0 * (double)PI * fmod(seconds, p->period) / p->period;
    lmp_light *e = &light->emitter;
    if (scene_light_has(light, SCENE_LIGHT_POSITION))
        e->position = rotate_around(p->axis, p->center, angle, e->position);
    scene_light_rotate(e, rotate, &(rotation) { p->axis, angle });
}

/* Returns the speed at a key: from the neighbor before it to the neighbor after it. */
static double speed_at(const path *p, size_t i, int k) {
    const size_t before = i > 0 ? i - 1 : 0, after = i + 1 < p->key_count ? i + 1 : i;
    return (p->keys[after].offset[k] - p->keys[before].offset[k]) /
           (p->keys[after].time - p->keys[before].time);
}

static void follow_keys(const path *p, double seconds, scene_light *light) {
    const double time = fmod(seconds, p->period);
    size_t low = 0, high = p->key_count - 1;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        *(p->keys[middle].time <= time ? &low : &high) = middle;
    }
    const path_key *from = &p->keys[low], *to = &p->keys[high];
    const double step = to->time - from->time, u = (time - from->time) / step;
    float center[3];
    vec_store(light->emitter.position, center);
    for (int k = 0; k < 3; k++) {
        const double way = to->offset[k] - from->offset[k];
        double offset = from->offset[k] + way * u;
        if (p->smooth) /* Hermite's cubic, as its difference from the straight line */
            offset += u * (1.0 - u) *
                      ((1.0 - u) * (speed_at(p, low, k) * step - way) -
                       u * (speed_at(p, high, k) * step - way));
        center[k] = (float)((double)center[k] + offset);
    }
    light->emitter.position = vec_load(center);
}

/* Clamps a coordinate to the range that lights may have. */
static void hold_in_reach(float *coordinate) {
    *coordinate = fmaxf(-LMP_LENGTH_MAX, fminf(*coordinate, LMP_LENGTH_MAX));
}

void animation_move(const animation *all, size_t number, double seconds, scene_light *light) {
    const path *p = number < all->path_count ? &all->paths[number] : &all->rest;
    if (p->kind != PATH_CIRCLE && !scene_light_has(light, SCENE_LIGHT_POSITION))
        return;
    switch (p->kind) {
    case PATH_REST:
        break;
    case PATH_ORBIT:
        orbit(all, number, seconds, light);
        break;
    case PATH_BOUNCE:
        if (p->period > 0.0)
            bounce(p->bottom, p->period, seconds, light);
        else
            bounce((double)all->minimum[1], bounce_period(all, light), seconds, light);
        break;
    case PATH_CIRCLE:
        circle(p, seconds, light);
        break;
    case PATH_KEYS:
        follow_keys(p, seconds, light);
        break;
    }
    hold_in_reach(&light->emitter.position.x);
    hold_in_reach(&light->emitter.position.y);
    hold_in_reach(&light->emitter.position.z);
}

void animation_move_all(const animation *all, const scene *world, double seconds,
                        scene_light *moved) {
    for (size_t i = 0; i < world->light_count; i++) {
        moved[i] = world->lights[i];
        animation_move(all, i, seconds, &moved[i]);
    }
}

/* --- opening ---------------------------------------------------------------------------------- */

/* Converts the motions of the scene file to keys at even steps. */
static bool take_motions(const scene *world, animation *all, base_error *error) {
    if (world->motion_count == 0)
        return base_fail(error, world->name, "does not move its lights (--animate orbit does)");
    for (size_t i = 0; i < world->motion_count; i++) {
        const scene_motion *motion = &world->motions[i];
        path *p = &all->paths[motion->light];
        p->keys = calloc(motion->count, sizeof *p->keys);
        if (!p->keys)
            return base_fail(error, NULL, "out of memory");
        p->kind = PATH_KEYS;
        p->period = (double)motion->period;
        p->key_count = motion->count;
        for (size_t k = 0; k < motion->count; k++) {
            p->keys[k].time = p->period * (double)k / (double)(motion->count - 1);
            const lmp_vec3 *offset = &world->offsets[motion->first + k];
            p->keys[k].offset[0] = (double)offset->x;
            p->keys[k].offset[1] = (double)offset->y;
            p->keys[k].offset[2] = (double)offset->z;
        }
    }
    return true;
}

static bool open_paths(const char *name, const scene *world, animation *all, base_error *error) {
    const char *const known[] = { "orbit", "bounce", "scene", NULL };
    all->paths = calloc(world->light_count + 1, sizeof *all->paths);
    if (!all->paths)
        return base_fail(error, NULL, "out of memory");
    if (strcmp(name, "orbit") == 0 || strcmp(name, "bounce") == 0) {
        all->rest.kind = name[0] == 'o' ? PATH_ORBIT : PATH_BOUNCE;
        return true;
    }
    all->path_count = world->light_count;
    if (strcmp(name, "scene") == 0)
        return take_motions(world, all, error);
    const char *dot = strrchr(name, '.'), *nearest = choice_nearest(name, known);
    if (!dot && nearest)
        return base_fail(error, name, "is not a path of lights (did you mean %s?)", nearest);
    if (!dot)
        return base_fail(error, name, "is not a path of lights (there are " ANIMATION_NAMES ")");
    return animation_read_paths(name, world, all->paths, error);
}

bool animation_open(const char *name, const scene *world, animation **opened, base_error *error) {
    animation *all = *opened = calloc(1, sizeof *all);
    if (!all)
        return base_fail(error, NULL, "out of memory");
    memcpy(all->minimum, world->minimum, sizeof all->minimum);
    memcpy(all->maximum, world->maximum, sizeof all->maximum);
    if (open_paths(name ? name : world->motion_count > 0 ? "scene" : "orbit", world, all, error))
        return true;
    animation_close(all);
    *opened = NULL;
    return false;
}

void animation_close(animation *all) {
    if (!all)
        return;
    for (size_t i = 0; i < all->path_count; i++)
        free(all->paths[i].keys);
    free(all->paths);
    free(all);
}
