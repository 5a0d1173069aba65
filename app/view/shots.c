/* SPDX-License-Identifier: MIT */
/* shots.c - files that the viewer writes: screenshots, recordings, its state. */
#include "app/base/file_json.h"
#include "app/base/file_writer.h"
#include "app/view/aim.h"
#include "app/view/handles.h"
#include "app/view/panel.h"
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { SHOTS_MAX = 10000 };

/* Draws the settings with all samples and writes the image to a file. */
static bool write_shot(viewer *v, const view_settings *settings, const char *path,
                       base_error *error) {
    bool ok = true;
    if (v->fresh || v->sample != settings->samples - 1) {
        v->shoots = true;
        ok = view_compositor_draw(v->compositor, settings, 1, -1, &v->statistics, error);
        v->sample = settings->samples - 1;
        v->fresh = !ok;
        v->shoots = v->state.requests.cancel = false;
        if (ok)
            memcpy(v->good, settings, view_settings_size(settings));
    }
    return ok && view_images_write(view_compositor_images(v->compositor), settings, path, error);
}

/* Finds the first numbered name that no file has; returns false if all are taken. */
static bool find_name(const char *beginning, const char *ending, char *name, size_t size) {
    struct stat status;
    for (int i = 1; i < SHOTS_MAX; i++) {
        snprintf(name, size, "%s-%04d%s", beginning, i, ending);
        if (stat(name, &status) != 0 && errno == ENOENT)
            return true;
    }
    return false;
}

bool view_export(viewer *v, const char *path, base_error *error) {
    const view_settings *now = &v->state.now;
    char lost[VIEW_MESSAGE_SIZE] = "";
    if (!scene_is_gltf(path)) {
        if (!scene_write_lights(path, now->origin, now->lights, now->light_count, error))
            return false;
        view_say(&v->state, "%s: --lights reads it, or drop it here", path);
        return true;
    }
    if (!scene_export_gltf(v->world, now->lights, now->light_count, path, lost, sizeof lost, error))
        return false;
    if (lost[0])
        base_note(path, "%s", lost);
    view_say(&v->state, "%s has the lights%s%s", path, lost[0] ? ", " : "", lost);
    return true;
}

/* Exports under a numbered name. */
static void export_next(viewer *v, const char *beginning, const char *ending) {
    char path[VIEW_PATH_SIZE + 16];
    base_error error;
    if (!find_name(beginning, ending, path, sizeof path))
        view_say(&v->state, "There are too many files of lights here");
    else if (!view_export(v, path, &error))
        view_say(&v->state, "%s", error.text);
}

void view_export_lights(viewer *v) {
    export_next(v, "lampion-lights", ".json");
}

void view_export_scene(viewer *v) {
    const char *from = v->state.now.scene, *dot = strrchr(from, '.');
    char beginning[VIEW_PATH_SIZE];
    if (scene_is_gltf(from)) {
        snprintf(beginning, sizeof beginning, "%.*s-lit", (int)(dot - from), from);
        export_next(v, beginning, dot);
    } else {
        view_say(&v->state, "Only glTF carries lights: export them as lampion-lights-0001.json");
    }
}

bool view_take_shot(viewer *v, const char *path, base_error *error) {
    const bool scripted = path;
    char name[64];
    if (!path && find_name("lampion", ".png", name, sizeof name))
        path = name;
    if (!path)
        view_say(&v->state, "There are too many screenshots here");
    else if (write_shot(v, v->drawn, path, error))
        view_say(&v->state, "%s: lampion render --from repeats it", path);
    else if (scripted && !v->state.requests.quit)
        return false;
    else
        view_say(&v->state, "%s", error->text);
    return true;
}

/* The scene and its files are named as they were to the viewer, from whose folder it runs. */
bool view_copy_command(viewer *v, base_error *error) {
    char name[64], command[256];
    if (!find_name("lampion", ".png", name, sizeof name))
        return base_fail(error, NULL, "There are too many screenshots here");
    if (!write_shot(v, v->drawn, name, error))
        return false;
    snprintf(command, sizeof command, "lampion render --from %s%s -o again.png", name,
             view_shot_confines(v->drawn, name) ? "" : " --allow-paths");
    view_window_copy(command);
    view_say(&v->state, "Copied: %s", command);
    return true;
}

void view_toggle_recording(viewer *v) {
    v->state.recording = !v->state.recording;
    if (!v->state.recording) {
        view_say(&v->state, "%s: %d frames", v->record, v->recorded);
        return;
    }
    for (int i = 1; !v->options->record && v->recorded == 0 && i < SHOTS_MAX; i++) {
        snprintf(v->record, sizeof v->record, "lampion-record-%03d", i);
        if (mkdir(v->record, 0777) == 0)
            return;
    }
}

bool view_record_frame(viewer *v, base_error *error) {
    char path[VIEW_PATH_SIZE + 32];
    snprintf(path, sizeof path, "%s/frame_%06d.png", v->record, v->recorded);
    if (write_shot(v, v->drawn, path, error)) {
        v->recorded++;
        return true;
    }
    v->state.recording = false;
    view_say(&v->state, "%s", error->text);
    return !v->options->record;
}

/* Adds the selected row of the panel as it is drawn. */
static json_t *with_panel(json_t *ui, const view_state *s) {
    view_row rows[VIEW_PANEL_ROWS];
    const int count = view_panel_rows(s, rows);
    for (int i = 0; i < count; i++)
        if (rows[i].chosen) {
            ui = file_json_with(ui, "panel", file_json_string(rows[i].name));
            ui = file_json_with(ui, "value", file_json_string(rows[i].value));
        }
    return ui;
}

static json_t *with_place(json_t *places, const char *name) {
    double x, y;
    return ui_find(name, &x, &y) ? file_json_with(places, name, json_pack("[f, f]", x, y)) : places;
}

/* Lists where the sidebar's title, headings and buttons are that are seen, for tests by input. */
static json_t *places_to_json(void) {
    json_t *places = with_place(json_object(), VIEW_SIDEBAR_TITLE);
    for (const view_key *row = view_keys; row->key || row->shown; row++) {
        const char *name = row->act ? row->name : view_is_heading(row) ? row->shown : NULL;
        if (name)
            places = with_place(places, name);
    }
    return places;
}

/* Lists where each handle of the selected light can be grabbed. */
static json_t *handles_to_json(const view_state *s) {
    json_t *places = json_object();
    view_marks marks;
    view_find_marks(s, &marks);
    for (int i = 0; i < marks.count; i++)
        if (marks.of[i].handle != VIEW_HANDLE_NONE)
            places = file_json_with(
                places, view_handle_names[marks.of[i].handle],
                json_pack("[f, f]", (double)marks.of[i].at[0][0], (double)marks.of[i].at[0][1]));
    return places;
}

static json_t *ui_to_json(const viewer *v) {
    const view_state *s = &v->state;
    json_t *ui =
        json_pack("{s:i, s:f, s:b, s:o, s:i, s:i, s:b, s:b, s:b}", "frame", v->frame, "seconds",
                  s->seconds, "playing", s->playing, "path",
                  file_json_string(s->paths.names[s->paths.at]), "selected", s->selected, "side",
                  view_side(s), "help", s->help, "overlay", s->overlay, "walking", s->walking);
    ui = with_panel(ui, s);
    ui = file_json_with(ui, "sidebar", json_boolean(s->sidebar));
    ui = file_json_with(ui, "places", places_to_json());
    ui = file_json_with(ui, "handles", handles_to_json(s));
    ui = file_json_with(ui, "aim", file_json_string(view_aim_names[s->aim]));
    if (s->shares.of)
        ui = file_json_with(ui, "shares", view_shares_to_json(&s->shares));
    ui = file_json_with(ui, "recording", json_boolean(s->recording));
    ui = file_json_with(ui, "recorded", json_integer(v->recorded));
    ui = file_json_with(ui, "message", file_json_string(s->message));
    ui = file_json_with(ui, "sample", json_integer(v->sample));
    ui = file_json_with(ui, "percent", json_integer(v->percent));
    ui = file_json_with(ui, "cancelled", json_integer(v->cancelled));
    ui = file_json_with(ui, "drawn_width", json_integer(v->statistics.width));
    ui = file_json_with(ui, "drawn_height", json_integer(v->statistics.height));
    ui = file_json_with(ui, "moving_frame_ms", file_json_real(1e3 * v->frame_seconds));
    ui = file_json_with(ui, "show_ms", file_json_real(1e3 * v->show_seconds));
    ui = file_json_with(ui, "gbuffer_ms", file_json_real(v->statistics.times.surfaces));
    ui = file_json_with(ui, "shade_ms", file_json_real(v->statistics.times.shade));
    ui = file_json_with(ui, "shadow_ms", file_json_real(v->statistics.times.shadow));
    ui = file_json_with(ui, "bounces_ms", file_json_real(v->statistics.times.bounces));
    return file_json_with(ui, "transfer_ms", file_json_real(v->statistics.times.transfer));
}

bool view_write_state(viewer *v, base_error *error) {
    json_t *root = file_json_with(view_settings_to_json(v->drawn), "view", ui_to_json(v));
    char *text = file_json_text(root, true, v->options->state, error);
    const bool ok = text && file_write_whole(v->options->state, text, strlen(text), error);
    free(text);
    return ok;
}
