/* SPDX-License-Identifier: MIT */
/* shots.c - what the viewer writes: screenshots, recordings, its state. */
#include "app/file/file.h"
#include "app/view/panel.h"
#include "app/view/viewer.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

enum { SHOTS_MAX = 10000 };

/* The settings with all samples, to a file. */
static bool write_shot(viewer *v, const view_settings *settings, const char *path,
                       cli_error *error) {
    bool ok = true;
    if (v->fresh || v->sample != settings->samples - 1) {
        ok = view_compositor_draw(v->compositor, settings, &v->statistics, error);
        v->sample = settings->samples - 1;
        v->fresh = !ok;
    }
    return ok && view_compositor_write(v->compositor, settings, path, error);
}

/* The first of numbered names that no file has yet; false if all are taken. */
static bool find_name(const char *beginning, const char *ending, char *name, size_t size) {
    struct stat status;
    for (int i = 1; i < SHOTS_MAX; i++) {
        snprintf(name, size, "%s-%04d%s", beginning, i, ending);
        if (stat(name, &status) != 0 && errno == ENOENT)
            return true;
    }
    return false;
}

void view_save_lights(viewer *v) {
    const view_settings *now = &v->state.now;
    char name[64];
    cli_error error;
    if (!find_name("lampion-lights", ".json", name, sizeof name))
        view_say(&v->state, "There are too many files of lights here");
    else if (scene_write_lights(name, now->origin, now->lights, now->light_count, &error))
        view_say(&v->state, "%s: --lights reads it, or drop it here", name);
    else
        view_say(&v->state, "%s", error.text);
}

bool view_take_shot(viewer *v, const char *path, cli_error *error) {
    const bool scripted = path;
    char name[64];
    if (!path && find_name("lampion", ".png", name, sizeof name))
        path = name;
    if (!path)
        view_say(&v->state, "There are too many screenshots here");
    else if (write_shot(v, v->drawn, path, error))
        view_say(&v->state, "%s: lampion render --from repeats it", path);
    else if (scripted)
        return false;
    else
        view_say(&v->state, "%s", error->text);
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

bool view_record_frame(viewer *v, cli_error *error) {
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

/* The chosen row of the panel, as it is drawn. */
static void add_panel(cJSON *ui, const view_state *s) {
    view_row rows[VIEW_PANEL_ROWS];
    const int count = view_panel_rows(s, rows);
    for (int i = 0; i < count; i++)
        if (rows[i].chosen) {
            cJSON_AddStringToObject(ui, "panel", rows[i].name);
            cJSON_AddStringToObject(ui, "value", rows[i].value);
        }
}

bool view_write_state(viewer *v, cli_error *error) {
    const view_state *s = &v->state;
    cJSON *root = view_settings_to_json(v->drawn);
    cJSON *ui = cJSON_AddObjectToObject(root, "view");
    cJSON_AddNumberToObject(ui, "frame", v->frame);
    cJSON_AddNumberToObject(ui, "seconds", s->seconds);
    cJSON_AddBoolToObject(ui, "playing", s->playing);
    cJSON_AddStringToObject(ui, "path", s->path_names[s->path]);
    cJSON_AddNumberToObject(ui, "selected", s->selected);
    cJSON_AddNumberToObject(ui, "side", view_side(s));
    cJSON_AddBoolToObject(ui, "help", s->help);
    cJSON_AddBoolToObject(ui, "overlay", s->overlay);
    cJSON_AddBoolToObject(ui, "walking", s->walking);
    add_panel(ui, s);
    cJSON_AddBoolToObject(ui, "recording", s->recording);
    cJSON_AddNumberToObject(ui, "recorded", v->recorded);
    cJSON_AddStringToObject(ui, "message", s->message);
    cJSON_AddNumberToObject(ui, "sample", v->sample);
    cJSON_AddNumberToObject(ui, "drawn_width", v->statistics.width);
    cJSON_AddNumberToObject(ui, "drawn_height", v->statistics.height);
    cJSON_AddNumberToObject(ui, "moving_frame_ms", 1e3 * v->frame_seconds);
    cJSON_AddNumberToObject(ui, "show_ms", 1e3 * v->show_seconds);
    cJSON_AddNumberToObject(ui, "gbuffer_ms", v->statistics.times.surfaces);
    cJSON_AddNumberToObject(ui, "shade_ms", v->statistics.times.shade);
    cJSON_AddNumberToObject(ui, "shadow_ms", v->statistics.times.shadow);
    cJSON_AddNumberToObject(ui, "transfer_ms", v->statistics.times.transfer);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    bool ok = text || cli_fail(error, v->options->state, "out of memory");
    ok = ok && file_write_whole(v->options->state, text, strlen(text), error);
    cJSON_free(text);
    return ok;
}
