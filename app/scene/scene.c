/* SPDX-License-Identifier: MIT */
#include "app/scene/scene.h"

#include "app/scene/blob.h"
#include "app/scene/builtin.h"
#include "app/scene/import.h"
#include "app/scene/vector.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#define BUILTIN_PREFIX "builtin:"
#define DEFAULT_FOV    0.7854f /* 45° */
#define FRAMING_SHARE  0.9f    /* of the image that an automatic camera fills at most */

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

/* "atrium" and "bultin:atrium" are no files: says what may be meant. Returns false. */
static bool hint_builtin(const char *name, cli_error *error) {
    const char *const colon = strchr(name, ':'), *const word = colon ? colon + 1 : name;
    for (size_t i = 0; scene_builtin_name(i) && access(name, F_OK) != 0; i++) {
        const char *const known = scene_builtin_name(i);
        if (strncmp(word, known, strcspn(word, ":")) == 0 && strcspn(word, ":") == strlen(known))
            return cli_fail(error, name, "does not exist (did you mean " BUILTIN_PREFIX "%s?)",
                            word);
    }
    return false;
}

void scene_left_out_text(const scene_left_out *item, char *text, size_t size) {
    const char last = item->noun[0] ? item->noun[strlen(item->noun) - 1] : 0;
    const char *ending = item->count == 1 ? "" : last == 'h' ? "es" : "s"; /* mesh, meshes */
    if (item->what[0])
        snprintf(text, size, "%s (%u %s%s)", item->what, item->count, item->noun, ending);
    else
        snprintf(text, size, "%u %s%s", item->count, item->noun, ending);
}

/* What is left out, in one line: on stderr, or as the error of a strict reading. */
static bool tell_left_out(const scene *s, bool strict, cli_error *error) {
    char line[sizeof error->text] = "";
    size_t used = 0;
    for (size_t i = 0; i < s->left_out_count; i++) {
        char text[2 * SCENE_NAME_SIZE + 32];
        scene_left_out_text(&s->left_out[i], text, sizeof text);
        const int length =
            snprintf(line + used, sizeof line - used, "%s%s", used ? ", " : "", text);
        if ((size_t)length >= sizeof line - used)
            break;
        used += (size_t)length;
    }
    if (!used)
        return true;
    if (strict)
        return cli_fail(error, s->origin, "left out: %s (not allowed by --strict)", line);
    fprintf(stderr, "lampion: %s: left out: %s\n", s->origin, line);
    return true;
}

bool scene_load(const char *name, const scene_options *options, scene *s, cli_error *error) {
    memset(s, 0, sizeof *s);
    if (strncmp(name, BUILTIN_PREFIX, strlen(BUILTIN_PREFIX)) == 0)
        return load_builtin(name, s, error);
    if (!import_scene(name, options && options->no_cache, s, error))
        return hint_builtin(name, error);
    if (tell_left_out(s, options && options->strict, error))
        return true;
    scene_free(s);
    return false;
}

void scene_free(scene *s) {
    if (s->mapped)
        munmap(s->block, s->block_size);
    else
        free(s->block);
    free(s->lights);
    memset(s, 0, sizeof *s);
}

/* From how far away in the direction `from` every triangle fits into the image. */
static float framing_distance(const scene *s, lmp_vec3 center, lmp_vec3 from, float aspect) {
    const lmp_vec3 right = vec_normalize(vec_cross(vec(0.0f, 1.0f, 0.0f), from), from);
    const lmp_vec3 up = vec_cross(from, right);
    const float slope = FRAMING_SHARE * tanf(0.5f * DEFAULT_FOV);
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

scene_camera scene_default_camera(const scene *s, float aspect) {
    if (s->camera_count > 0) {
        scene_camera first = s->cameras[0];
        if (aspect > 0.0f && aspect < first.aspect)
            first.fov = 2.0f * atanf(tanf(0.5f * first.fov) * first.aspect / aspect);
        return first;
    }
    const lmp_vec3 lo = vec_load(s->minimum), hi = vec_load(s->maximum);
    const lmp_vec3 center = vec_add(vec_scale(lo, 0.5f), vec_scale(hi, 0.5f));
    const lmp_vec3 from = vec_normalize(vec(0.45f, 0.35f, 1.0f), vec(0.0f, 0.0f, 1.0f));
    const float distance = framing_distance(s, center, from, aspect > 0.0f ? aspect : 1.0f);
    scene_camera camera = { .name = "framed", .up = { 0.0f, 1.0f, 0.0f }, .fov = DEFAULT_FOV };
    vec_store(center, camera.target);
    vec_store(vec_add(center, vec_scale(from, distance)), camera.eye);
    return camera;
}
