/* SPDX-License-Identifier: MIT */
/* reload.c - the viewer's scene, read again when its file changes. */
#include "app/view/viewer.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WATCH_SECONDS 0.5 /* between looks at the scene file */

static bool is_file(const char *name) {
    return strncmp(name, "builtin:", 8) != 0;
}

version view_version_of(const char *path) {
    struct stat status;
    if (!is_file(path) || stat(path, &status) != 0)
        return (version) { 0, 0, -1 };
    return (version) { status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size };
}

static bool same_version(version a, version b) {
    return a.seconds == b.seconds && a.nanoseconds == b.nanoseconds && a.size == b.size;
}

scene *view_load_scene(const view_options *o, cli_error *error) {
    scene *world = calloc(1, sizeof *world);
    if (!world) {
        cli_fail(error, NULL, "out of memory");
        return NULL;
    }
    if (scene_load(o->settings.scene, &o->load, world, error) &&
        scene_apply_lights(world, &o->lights, error))
        return world;
    scene_free(world);
    free(world);
    return NULL;
}

void view_free_scene(scene *world) {
    if (world)
        scene_free(world);
    free(world);
}

/* Materials that the scene has not any more are not replaced any more. */
static void drop_lost_materials(view_state *state) {
    for (int i = state->now.material_count - 1; i >= 0; i--) {
        char name[SCENE_NAME_SIZE] = "";
        bool found = false;
        memcpy(name, state->now.materials[i], strcspn(state->now.materials[i], "=") % sizeof name);
        for (size_t m = 0; m < state->world->material_count; m++)
            found = found || strcmp(state->world->materials[m].name, name) == 0;
        if (!found)
            view_set_material(&state->now, name, NULL);
    }
}

void view_reload(viewer *v) {
    cli_error error;
    scene *world = view_load_scene(v->options, &error);
    view_compositor *compositor = world ? view_compositor_create(&v->context, world, &error) : NULL;
    if (!compositor || !view_state_replace_scene(&v->state, world, &error)) {
        view_compositor_destroy(compositor);
        view_free_scene(world);
        view_say(&v->state, "%s", error.text);
        return;
    }
    view_compositor_destroy(v->compositor);
    view_free_scene(v->world);
    v->world = world;
    v->compositor = compositor;
    v->fresh = true;
    memset(v->labels, 0, sizeof v->labels);
    drop_lost_materials(&v->state);
    view_say(&v->state, "%s: read again", v->options->settings.scene);
}

void view_watch(viewer *v) {
    if (!is_file(v->options->settings.scene) || v->clock < v->watched_at + WATCH_SECONDS)
        return;
    v->watched_at = v->clock;
    const version now = view_version_of(v->options->settings.scene);
    const bool rests = same_version(now, v->candidate);
    v->candidate = now;
    if (same_version(now, v->seen) || !rests || now.size < 0)
        return;
    v->seen = now;
    v->state.wishes.reload = true;
}
