/* SPDX-License-Identifier: MIT */
#include "app/scene/scene.h"

#include "app/scene/blob.h"
#include "app/scene/builtin.h"
#include "app/scene/import.h"
#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#define BUILTIN_PREFIX   "builtin:"
#define DEFAULT_FOV      0.7854f /* 45° */
#define FRAMING_DISTANCE 1.05f   /* of an automatic camera, 1: the bounding sphere just fits */

static bool load_builtin(const char *name, scene *s, cli_error *error) {
    scene_builder builder = { 0 };
    void *block = NULL;
    size_t size = 0;
    bool ok = builtin_make(name + strlen(BUILTIN_PREFIX), &builder, error);
    if (ok && !builder_pack(&builder, &block, &size))
        ok = cli_fail(error, name, "does not fit into memory (ask for fewer tiles)");
    builder_free(&builder);
    ok = ok && blob_validate(block, size, false, name, error) &&
         blob_open(block, size, name, s, error);
    if (!ok)
        free(block);
    return ok;
}

bool scene_load(const char *name, const scene_options *options, scene *s, cli_error *error) {
    memset(s, 0, sizeof *s);
    if (strncmp(name, BUILTIN_PREFIX, strlen(BUILTIN_PREFIX)) == 0)
        return load_builtin(name, s, error);
    return import_scene(name, options && options->no_cache, s, error);
}

void scene_free(scene *s) {
    if (s->mapped)
        munmap(s->block, s->block_size);
    else
        free(s->block);
    free(s->lights);
    memset(s, 0, sizeof *s);
}

scene_camera scene_default_camera(const scene *s, float aspect) {
    if (s->camera_count > 0) {
        scene_camera first = s->cameras[0];
        if (aspect > 0.0f && aspect < first.aspect)
            first.fov = 2.0f * atanf(tanf(0.5f * first.fov) * first.aspect / aspect);
        return first;
    }
    const lmp_vec3 lo = vec_load(s->minimum), hi = vec_load(s->maximum);
    const lmp_vec3 center = vec_scale(vec_add(lo, hi), 0.5f);
    const float radius = 0.5f * vec_length(vec_sub(hi, lo));
    /* The smaller of the two half angles must hold the bounding sphere. */
    const float half = 0.5f * DEFAULT_FOV;
    const float narrow = aspect < 1.0f ? atanf(tanf(half) * aspect) : half;
    const float distance = FRAMING_DISTANCE * fmaxf(radius, 1e-6f) / sinf(narrow);
    const lmp_vec3 from = vec_normalize(vec(0.45f, 0.35f, 1.0f), vec(0.0f, 0.0f, 1.0f));
    scene_camera camera = { .name = "framed", .up = { 0.0f, 1.0f, 0.0f }, .fov = DEFAULT_FOV };
    vec_store(center, camera.target);
    vec_store(vec_add(center, vec_scale(from, distance)), camera.eye);
    return camera;
}
