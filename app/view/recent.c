/* SPDX-License-Identifier: MIT */
/* recent.c - what the viewer remembers between its runs, in the user's folder for states: the last
 * scenes, and how each was left. Where it cannot be kept, it is not. */
#include "app/base/file.h"
#include "app/base/file_cache.h"
#include "app/base/file_hash.h"
#include "app/base/file_json.h"
#include "app/base/file_writer.h"
#include "app/view/viewer.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SIZE_LIMIT ((size_t)64 << 20)
typedef char file_path[PATH_MAX + 64];

static bool path_of(const char *name, file_path path) {
    char folder[PATH_MAX];
    return file_state_directory(folder, sizeof folder) &&
           snprintf(path, sizeof(file_path), "%s/%s", folder, name) < (int)sizeof(file_path);
}

/* Finds the file for how a scene was left. */
static bool session_path_of(const char *full_name, file_path path) {
    char name[64];
    file_hash hash = { .low = 0 };
    file_hash_add(&hash, full_name, strlen(full_name));
    file_hash_text(&hash, name);
    return path_of(strcat(name, ".json"), path);
}

/* Finds the name of a scene that holds in every folder; returns false if there is none. */
static bool full_name_of(const char *given, char name[VIEW_PATH_SIZE]) {
    char real[PATH_MAX];
    if (file_is_standard_input(given) || (scene_is_file(given) && !realpath(given, real)))
        return false;
    const char *full = scene_is_file(given) ? real : given;
    return snprintf(name, VIEW_PATH_SIZE, "%s", full) < VIEW_PATH_SIZE;
}

static bool write_json(const char *path, json_t *root) {
    base_error ignored;
    char *text = file_json_text(root, true, path, &ignored);
    const bool ok = text && file_write_whole(path, text, strlen(text), &ignored);
    free(text);
    return ok;
}

/* Reads the list; returns false if there is none yet. */
static bool read_list(view_recent *recent) {
    file_path path;
    base_error ignored;
    json_t *root = path_of("recent.json", path) ? file_read_json(path, SIZE_LIMIT, &ignored) : NULL;
    json_t *list = json_object_get(root, "recent"), *item;
    size_t i;
    recent->count = 0;
    json_array_foreach (list, i, item) {
        const char *name = json_is_string(item) ? json_string_value(item) : "";
        if (name[0] && strlen(name) < VIEW_PATH_SIZE && recent->count < VIEW_RECENT_MAX)
            strcpy(recent->scenes[recent->count++], name);
    }
    const bool found = root;
    json_decref(root);
    return found;
}

/* Puts a scene at the front of the list. */
static void add(view_recent *recent, const char *full_name) {
    file_path path;
    int at = 0;
    while (at < recent->count && strcmp(recent->scenes[at], full_name) != 0)
        at++;
    if (at == VIEW_RECENT_MAX && session_path_of(recent->scenes[--at], path))
        unlink(path);
    if (at == recent->count)
        recent->count++;
    memmove(recent->scenes[1], recent->scenes[0], (size_t)at * sizeof *recent->scenes);
    strcpy(recent->scenes[0], full_name);
    if (!path_of("recent.json", path))
        return;
    json_t *list = json_array();
    for (int i = 0; i < recent->count; i++)
        list = file_json_append(list, file_json_string(recent->scenes[i]));
    write_json(path, json_pack("{s:o}", "recent", list));
}

void view_begin_session(viewer *v) {
    char name[VIEW_PATH_SIZE];
    v->opened_with = v->state.now.camera;
    if (!view_is_interactive(v))
        return;
    if (!read_list(&v->recent)) {
        view_say(&v->state, "F1 shows all keys, F3 shows and hides the panel");
        v->state.message_until = HUGE_VAL; /* a key or a click */
    }
    if (full_name_of(v->state.now.scene, name))
        add(&v->recent, name);
}

void view_keep_session(const viewer *v) {
    const view_state *s = &v->state;
    char name[VIEW_PATH_SIZE];
    file_path path;
    const bool changed =
        s->lights_edited || memcmp(&v->opened_with, &s->now.camera, sizeof v->opened_with) != 0;
    if (!view_is_interactive(v) || !changed || !full_name_of(s->now.scene, name) ||
        !session_path_of(name, path))
        return;
    json_t *root = view_settings_to_json(&s->now);
    write_json(path, file_json_with(root, "scene", file_json_string(name)));
}

void view_resume_session(viewer *v) {
    view_state *s = &v->state;
    char name[VIEW_PATH_SIZE];
    file_path path;
    base_error error;
    view_settings *last = calloc(1, sizeof *last);
    json_t *root = full_name_of(s->now.scene, name) && session_path_of(name, path)
                       ? file_read_json(path, SIZE_LIMIT, &error)
                       : NULL;
    if (last && root && view_settings_from_json(root, path, last, &error) &&
        last->up == s->now.up) {
        view_settings_rebase(last, s->now.origin);
        s->now.environment = last->environment;
        s->now.exposure = last->exposure;
        s->now.camera = last->camera;
        view_put_lights(s, last->lights, last->light_count);
        view_keep(s);
        view_say(s, "Camera and lights are as they were left");
    } else {
        view_say(s, "Nothing is known of an earlier session of this scene");
    }
    json_decref(root);
    free(last);
}
