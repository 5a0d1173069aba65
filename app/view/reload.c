/* SPDX-License-Identifier: MIT */
/* reload.c - reloads the viewer's scene when its file changes. */
#include "app/base/timing.h"
#include "app/render/renderer/renderer.h"
#include "app/view/nodes.h"
#include "app/view/viewer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WATCH_SECONDS 0.5 /* between checks of the scene file */

version view_version_of(const char *path) {
    struct stat status;
    if (!scene_is_file(path) || stat(path, &status) != 0)
        return (version) { 0, 0, -1 };
    return (version) { status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size };
}

static bool same_version(version a, version b) {
    return a.seconds == b.seconds && a.nanoseconds == b.nanoseconds && a.size == b.size;
}

void view_free_scene(scene *world) {
    if (world)
        scene_free(world);
    free(world);
}

/* A scene to load beside the window. */
typedef struct loading {
    char name[VIEW_PATH_SIZE], variant[SCENE_NAME_SIZE];
    scene_options load;
    const scene_lights_options *lights;
    scene *world;
    base_error *error;
} loading;

static bool load(void *of) {
    loading *l = of;
    scene *world = l->world;
    const bool ok = scene_load(l->name, &l->load, world, l->error) &&
                    scene_apply_lights(world, l->lights, l->error);
    if (ok)
        scene_is_inside(world); /* takes long the first time */
    return ok;
}

scene *view_load_scene(viewer *v, const char *name, const scene_options *options,
                       const scene_lights_options *lights, base_error *error) {
    loading l = { .load = *options, .lights = lights, .error = error };
    l.world = calloc(1, sizeof *l.world);
    if (!l.world) {
        base_fail(error, NULL, "out of memory");
        return NULL;
    }
    /* copies: another scene may be chosen meanwhile */
    strcpy(l.name, name);
    strcpy(l.variant, options->variant ? options->variant : "");
    l.load.variant = options->variant ? l.variant : NULL;
    v->loading = (progress_watch) { 0 };
    v->loads = true;
    v->announcement = "Loading the scene …";
    v->load_began = timing_now();
    progress_follow(&v->loading);
    const bool ok = view_work_run(view_is_interactive(v) ? v->work : NULL, load, &l);
    progress_follow(NULL);
    v->loads = false;
    v->announcement = NULL;
    l.world->name = name;
    if (ok)
        return l.world;
    view_free_scene(l.world);
    return NULL;
}

/* Drops replacements of materials that the scene no longer has. */
static void drop_lost_materials(view_state *state) {
    for (int i = state->now.materials.count - 1; i >= 0; i--) {
        const char *text = state->now.materials.texts[i];
        char name[SCENE_NAME_SIZE] = "";
        bool found = false;
        memcpy(name, text, strcspn(text, "=") % sizeof name);
        for (size_t m = 0; m < state->world->material_count; m++)
            found = found || strcmp(state->world->materials[m].name, name) == 0;
        if (!found)
            view_set_material(&state->now, name, NULL);
    }
}

/* Whether shadows suit the scene on its devices: rays run on the CPU, and a GPU would wait for
 * them. */
static bool suits_shadows(const scene *world, const char *surroundings) {
    const bool studio = strcmp(surroundings, "studio") == 0;
    return !render_finds_gpu() && environment_suits_shadows(studio, world);
}

bool view_choose_environment(viewer *v, base_error *error) {
    const view_options *o = v->options;
    view_settings *now = &v->state.now;
    view_environment *around = &now->environment;
    if (o->keep_lights && !v->another)
        return true;
    const environment_options chosen = environment_choose(&o->environment, v->world);
    if (strlen(chosen.name) >= sizeof around->name)
        return base_fail(error, chosen.name, "is too long a name");
    strcpy(around->name, chosen.name);
    around->rotation = chosen.rotation;
    around->strength = chosen.strength;
    around->ground = chosen.ground;
    if (!o->shadows_chosen)
        now->shadows = suits_shadows(v->world, chosen.name);
    return true;
}

void view_show_title(viewer *v) {
    char title[VIEW_PATH_SIZE + 16];
    snprintf(title, sizeof title, "%s - Lampion", v->state.now.scene);
    view_window_title(v->window, title);
}

/* What a scene is drawn and picked by. */
typedef struct drawing {
    scene *part;
    view_tree *tree;
    view_compositor *compositor;
} drawing;

static void close_drawing(drawing *d) {
    view_compositor_destroy(d->compositor);
    view_tree_end(d->tree);
    view_part_free(d->part);
}

/* Prepares to draw what the settings, or NULL, leave of a scene. */
static bool open_drawing(viewer *v, const scene *world, const view_settings *settings, drawing *d,
                         base_error *error) {
    *d = (drawing) { .part = view_part_make(world, settings, error) };
    d->tree = d->part ? view_tree_begin(d->part, error) : NULL;
    d->compositor =
        d->tree ? view_compositor_create(&v->context, d->part, d->tree, v->work, error) : NULL;
    if (!d->compositor)
        close_drawing(d);
    return d->compositor;
}

static void replace_drawing(viewer *v, const drawing *d) {
    view_compositor_inherit(d->compositor, v->compositor);
    close_drawing(&(drawing) { v->part, v->tree, v->compositor });
    v->part = d->part;
    v->tree = d->tree;
    v->compositor = d->compositor;
    v->fresh = true;
}

void view_change_part(viewer *v) {
    view_state *s = &v->state;
    drawing d;
    base_error error;
    if (open_drawing(v, v->world, &s->now, &d, &error)) {
        replace_drawing(v, &d);
        s->tree = d.tree;
    } else {
        s->now.hidden = v->drawn->hidden;
        view_say(s, "%s", error.text);
    }
}

static void begin_other(viewer *v) {
    base_error error;
    v->another = true;
    v->seen = v->candidate = view_version_of(v->state.now.scene);
    view_show_title(v);
    view_begin_session(v);
    if (!view_choose_environment(v, &error))
        view_say(&v->state, "%s", error.text);
}

void view_reload(viewer *v) {
    static const scene_lights_options own = { .file = NULL };
    const view_options *o = v->options;
    const bool other = v->state.other[0];
    base_error error;
    if (other)
        view_keep_session(v);
    const char *variant = other ? NULL : view_variant(&v->state.now);
    scene_options load = o->load;
    load.variant = variant;
    load.up = other ? SCENE_UP_AUTO : v->state.now.up;
    scene *world = view_load_scene(v, other ? v->state.other : v->state.now.scene, &load,
                                   other || v->another ? &own : &o->lights, &error);
    v->state.requests.cancel = false;
    if (v->state.requests.reload || v->state.requests.quit) { /* another scene was chosen since */
        view_free_scene(world);
        return;
    }
    drawing d = { .part = NULL };
    if (!world || !open_drawing(v, world, other ? NULL : &v->state.now, &d, &error) ||
        !view_state_replace_scene(&v->state, world, d.tree, &error)) {
        if (d.compositor)
            close_drawing(&d);
        view_free_scene(world);
        v->state.other[0] = '\0';
        view_say(&v->state, "%s", error.text);
        return;
    }
    replace_drawing(v, &d);
    view_free_scene(v->world);
    v->world = world;
    world->name = v->part->name = v->state.now.scene;
    if (other)
        begin_other(v);
    drop_lost_materials(&v->state);
    view_say(&v->state, other ? "%s" : "%s: read again", v->state.now.scene);
}

void view_watch(viewer *v) {
    if (!scene_is_file(v->state.now.scene) || v->clock < v->watched_at + WATCH_SECONDS)
        return;
    v->watched_at = v->clock;
    const version now = view_version_of(v->state.now.scene);
    const bool rests = same_version(now, v->candidate);
    v->candidate = now;
    if (same_version(now, v->seen) || !rests || now.size < 0)
        return;
    v->seen = now;
    v->state.requests.reload = true;
}
