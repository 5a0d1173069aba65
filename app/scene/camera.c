/* SPDX-License-Identifier: MIT */
/* The camera that a command line asks for. */
#include "app/scene/scene.h"
#include "app/scene/vector.h"
#include "app/scene/world.h"

#include <string.h>

static bool find_camera(const scene *world, const char *wanted, scene_camera *camera,
                        base_error *error) {
    size_t index;
    if (!scene_find_name(world->name, "camera", wanted, world->cameras->name,
                         sizeof *world->cameras, world->camera_count, &index, error))
        return false;
    *camera = world->cameras[index];
    return true;
}

/* Replaces an up direction that the camera looks along. */
static void keep_upright(scene_camera *camera) {
    float forward[3], along = 0, length2 = 0, up2 = 0;
    for (int i = 0; i < 3; i++) {
        forward[i] = camera->target[i] - camera->eye[i];
        along += forward[i] * camera->up[i];
        length2 += forward[i] * forward[i];
        up2 += camera->up[i] * camera->up[i];
    }
    if (along * along < 0.999f * length2 * up2)
        return;
    memcpy(camera->up, (const float[3]) { 0, 0, -1 }, sizeof camera->up);
}

/* Says which framing was chosen and how to get the other. */
static void tell_framing(const scene *world, const scene_camera_options *o) {
    if (world->camera_count > 0 || o->eye_given || !world->frame ||
        world->frame->wanted != SCENE_FRAMING_AUTO)
        return;
    base_note(world->name, scene_is_inside(world)
                               ? "no camera in it, seen from inside (--framing outside steps out)"
                               : "no camera in it, seen from outside (--framing inside steps in)");
}

bool scene_place_camera(const scene *world, const scene_camera_options *o, const int size[2],
                        scene_camera *camera, base_error *error) {
    *camera = scene_default_camera(world, (float)size[0] / (float)size[1]);
    if (o->name && world->frame && world->frame->wanted != SCENE_FRAMING_AUTO)
        return base_fail(error, "camera", "--camera and --framing exclude each other");
    tell_framing(world, o);
    if (o->name && !find_camera(world, o->name, camera, error))
        return false;
    if (o->eye_given) { /* the file's clipping planes suit its own eye alone */
        scene_point_from_world(world->origin, o->eye, camera->eye);
        camera->near = camera->far = 0;
    }
    if (o->target_given)
        scene_point_from_world(world->origin, o->target, camera->target);
    if (o->fov_given && o->height_given)
        return base_fail(error, "camera", "--fov and --orthographic exclude each other");
    if (o->fov_given) {
        camera->fov = o->fov * PI / 180;
        camera->height = 0;
    }
    if (o->height_given)
        camera->height = o->height;
    if (o->eye_given || o->target_given) {
        memcpy(camera->up, (const float[3]) { 0, 1, 0 }, sizeof camera->up);
        if (memcmp(camera->eye, camera->target, sizeof camera->eye) == 0)
            return base_fail(error, "camera", "--eye and --target are the same point");
    }
    for (int k = 0; k < 3; k++)
        if (!(fabsf(camera->eye[k]) <= LMP_LENGTH_MAX &&
              fabsf(camera->target[k]) <= LMP_LENGTH_MAX))
            return base_fail(error, world->name, "has a camera beyond 1e17 (--eye and --target)");
    keep_upright(camera);
    return true;
}
