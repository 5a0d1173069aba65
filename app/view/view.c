/* SPDX-License-Identifier: MIT */
/* The viewer's loop: events, time, an image as fine as there is time for, drawings over it. */
#include "app/view/view.h"
#include "app/file/file.h"
#include "app/scene/vector.h"
#include "app/view/overlay.h"
#include "app/view/script.h"
#include "app/view/stage.h"
#include "app/view/window.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define MOVING_SECONDS 0.060 /* a frame may take while things move */
#define STILL_SECONDS  0.12  /* after the last change, refining begins */
#define WATCH_SECONDS  0.5   /* between looks at the scene file */
#define PANEL_SECONDS  0.25  /* between updates of the figures */
enum { DIVISOR_MAX = 6, SHOTS_MAX = 10000, PANEL_ROWS = 16 };

enum { DRAWING_PANEL, DRAWING_HELP, DRAWING_MESSAGE, DRAWING_RING, DRAWING_LEFT, DRAWING_RIGHT };

/* The version of a file. */
typedef struct version {
    long long seconds, nanoseconds, size;
} version;

/* A drawing on the screen, made anew when what it says changes. */
typedef struct label {
    char text[VIEW_MESSAGE_SIZE];
    double scale;
    int width, height; /* of the drawing */
    int room;          /* it was made to fit */
} label;

/* What the drawings over an image show. */
typedef struct drawn_over {
    bool help, overlay, playing;
    int selected;
    char message[VIEW_MESSAGE_SIZE];
} drawn_over;

typedef struct viewer {
    const view_options *options;
    view_state state;
    view_script script;
    size_t script_next;
    scene *world;
    gpu_context context;
    view_window *window;
    view_stage *stage;
    view_settings *shown, *drawn, *good; /* now; on the screen; last that could be drawn */
    bool fresh;                          /* nothing of `drawn` is on the screen */
    int sample;                          /* of the refinement, on the screen; -1: a draft */
    int divisor;                         /* of the next draft */
    double changed_at, frame_seconds;    /* seconds: of the last change; a moving frame took */
    double slow_seconds; /* the frame before took, if it had the same size; else 0 */
    bool moves;          /* the camera, from the frame before to the one on the screen */
    double show_seconds; /* of these, scaling, drawing over it and the window */
    view_figures figures;
    version seen, candidate; /* of the scene file */
    double watched_at, panel_at, clock;
    int frame, recorded;
    char record[VIEW_PATH_SIZE];
    drawn_over over; /* the image on the screen */
    bool waiting;    /* for slow work that the screen has announced */
    label labels[GPU_DRAWINGS_MAX];
} viewer;

/* --- the scene ----------------------------------------------------------------------------------
 */

static bool is_file(const char *name) {
    return strncmp(name, "builtin:", 8) != 0;
}

static version version_of(const char *path) {
    struct stat status;
    if (!is_file(path) || stat(path, &status) != 0)
        return (version) { 0, 0, -1 };
    return (version) { status.st_mtim.tv_sec, status.st_mtim.tv_nsec, status.st_size };
}

static bool same_version(version a, version b) {
    return a.seconds == b.seconds && a.nanoseconds == b.nanoseconds && a.size == b.size;
}

static scene *load_scene(const view_options *o, cli_error *error) {
    scene *world = calloc(1, sizeof *world);
    if (!world) {
        cli_fail(error, NULL, "out of memory");
        return NULL;
    }
    if (scene_load(o->settings.scene, &(scene_options) { 0 }, world, error) &&
        scene_apply_lights(world, &o->lights, error))
        return world;
    scene_free(world);
    free(world);
    return NULL;
}

static void free_scene(scene *world) {
    if (world)
        scene_free(world);
    free(world);
}

/* Materials that the scene has not any more are not replaced any more. */
static void drop_lost_materials(view_state *state) {
    for (int i = state->now.material_count - 1; i >= 0; i--) {
        char slot[SCENE_NAME_SIZE] = "";
        bool found = false;
        memcpy(slot, state->now.materials[i], strcspn(state->now.materials[i], "=") % sizeof slot);
        for (size_t m = 0; m < state->world->material_count; m++)
            found = found || strcmp(state->world->materials[m].name, slot) == 0;
        if (!found)
            view_set_material(&state->now, slot, NULL);
    }
}

/* A scene that does not load leaves the one before. */
static void reload(viewer *v) {
    cli_error error;
    scene *world = load_scene(v->options, &error);
    view_stage *stage = world ? view_stage_create(&v->context, world, &error) : NULL;
    if (!stage || !view_state_replace_scene(&v->state, world, &error)) {
        view_stage_destroy(stage);
        free_scene(world);
        view_say(&v->state, "%s", error.text);
        return;
    }
    view_stage_destroy(v->stage);
    free_scene(v->world);
    v->world = world;
    v->stage = stage;
    v->fresh = true;
    memset(v->labels, 0, sizeof v->labels);
    drop_lost_materials(&v->state);
    view_say(&v->state, "%s: read again", v->options->settings.scene);
}

/* Reads the scene again once its file has changed and rests. */
static void watch(viewer *v) {
    if (!is_file(v->options->settings.scene) || v->clock < v->watched_at + WATCH_SECONDS)
        return;
    v->watched_at = v->clock;
    const version now = version_of(v->options->settings.scene);
    const bool rests = same_version(now, v->candidate);
    v->candidate = now;
    if (same_version(now, v->seen) || !rests || now.size < 0)
        return;
    v->seen = now;
    v->state.wishes.reload = true;
}

/* --- files out ----------------------------------------------------------------------------------
 */

/* The settings with all samples, to a file. */
static bool write_shot(viewer *v, const view_settings *settings, const char *path,
                       cli_error *error) {
    bool ok = true;
    if (v->fresh || v->sample != settings->samples - 1) {
        ok = view_stage_draw(v->stage, settings, &v->figures, error);
        v->sample = settings->samples - 1;
        v->fresh = !ok;
    }
    return ok && view_stage_write(v->stage, settings, path, error);
}

/* Of a script where path is given: then a failure ends the viewer. */
static bool take_shot(viewer *v, const char *path, cli_error *error) {
    const bool scripted = path;
    char name[64];
    struct stat status;
    for (int i = 1; !path && i < SHOTS_MAX; i++) {
        snprintf(name, sizeof name, "lampion-%04d.png", i);
        if (stat(name, &status) != 0 && errno == ENOENT)
            path = name;
    }
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

static void toggle_recording(viewer *v) {
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

/* Without --record a failure only ends the recording. */
static bool record_frame(viewer *v, cli_error *error) {
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

/* What the program knows of itself, for tests and for the curious. */
static bool write_state(viewer *v, cli_error *error) {
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
    cJSON_AddBoolToObject(ui, "recording", s->recording);
    cJSON_AddNumberToObject(ui, "recorded", v->recorded);
    cJSON_AddStringToObject(ui, "message", s->message);
    cJSON_AddNumberToObject(ui, "sample", v->sample);
    cJSON_AddNumberToObject(ui, "drawn_width", v->figures.width);
    cJSON_AddNumberToObject(ui, "drawn_height", v->figures.height);
    cJSON_AddNumberToObject(ui, "moving_frame_ms", 1e3 * v->frame_seconds);
    cJSON_AddNumberToObject(ui, "show_ms", 1e3 * v->show_seconds);
    cJSON_AddNumberToObject(ui, "gbuffer_ms", v->figures.times.gbuffer);
    cJSON_AddNumberToObject(ui, "shade_ms", v->figures.times.shade);
    cJSON_AddNumberToObject(ui, "transfer_ms", v->figures.times.transfer);
    char *text = cJSON_Print(root);
    cJSON_Delete(root);
    bool ok = text || cli_fail(error, v->options->state, "out of memory");
    ok = ok && file_write_whole(v->options->state, text, strlen(text), error);
    cJSON_free(text);
    return ok;
}

/* --- drawings -----------------------------------------------------------------------------------
 */

static void add_row(view_row *rows, int *count, const char *name, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

static void add_row(view_row *rows, int *count, const char *name, const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    view_row *row = &rows[(*count)++];
    snprintf(row->name, sizeof row->name, "%s", name);
    vsnprintf(row->value, sizeof row->value, format, arguments);
    va_end(arguments);
}

static void describe_look(const view_look *look, char *text, size_t size) {
    snprintf(text, size, "%s, %d band%s%s%s", gpu_method_names[look->method], look->bands,
             look->bands == 1 ? "" : "s", look->window == LMP_WINDOW_NONE ? "" : ", ",
             look->window == LMP_WINDOW_NONE ? "" : device_window_names[look->window]);
}

static int fill_panel(const viewer *v, view_row rows[PANEL_ROWS]) {
    const view_state *s = &v->state;
    const view_settings *d = v->drawn;
    const gpu_times *t = &v->figures.times;
    char look[96];
    int count = 0;
    add_row(rows, &count, "Lampion", "%s", "");
    add_row(rows, &count, "Scene", "%.100s", d->scene);
    describe_look(&d->looks[0], look, sizeof look);
    add_row(rows, &count, d->split == GPU_SPLIT_NONE ? "Shading" : "Left", "%s", look);
    if (d->split != GPU_SPLIT_NONE) {
        describe_look(&d->looks[1], look, sizeof look);
        add_row(rows, &count, "Right", "%s", look);
    }
    if (s->selected >= 0)
        add_row(rows, &count, "Lights", "%zu, number %d: radius %.3g", d->light_count, s->selected,
                (double)s->now.lights[s->selected].emitter.radius);
    else
        add_row(rows, &count, "Lights", "%zu", d->light_count);
    add_row(rows, &count, "Time", "%s %.2f s%s", s->path_names[s->path], s->seconds,
            s->playing ? "" : ", paused");
    if (v->frame_seconds > 0)
        add_row(rows, &count, "Moving", "%.0f ms a frame, %.1f a second", 1e3 * v->frame_seconds,
                1 / v->frame_seconds);
    add_row(rows, &count, "Image", "%d × %d, sample %d of %d", v->figures.width, v->figures.height,
            v->sample < 0 ? 1 : v->sample + 1, v->sample < 0 ? 1 : d->samples);
    add_row(rows, &count, "Geometry", "%.1f ms", t->gbuffer);
    add_row(rows, &count, "Shading", "%.1f ms on the %s", t->shade,
            v->figures.device == DEVICE_CPU ? "processor" : "GPU");
    if (t->transfer > 0)
        add_row(rows, &count, "Transfer", "%.1f ms", t->transfer);
    add_row(rows, &count, "Window", "%.1f ms", 1e3 * v->show_seconds);
    if (s->recording)
        add_row(rows, &count, "Recording", "%s, %d frames", v->record, v->recorded);
    return count;
}

/* Uploads a drawing as `index` and notes its size. */
static void upload(viewer *v, int index, view_drawing *drawing) {
    if (drawing->pixels) {
        gpu_screen_upload(view_stage_screen(v->stage), index, drawing->width, drawing->height,
                          drawing->pixels);
        v->labels[index].width = drawing->width;
        v->labels[index].height = drawing->height;
    }
    view_drawing_free(drawing);
}

static void put(viewer *v, int index, int x, int y) {
    const gpu_layout layout = { .width = v->drawn->width, .height = v->drawn->height };
    gpu_screen_draw(view_stage_screen(v->stage), &layout, index, x, y);
}

/* Whether a label has to be drawn anew to say this in that room. */
static bool outdated(label *l, const char *text, double scale, int room) {
    if (l->width > 0 && strcmp(l->text, text) == 0 && l->scale == scale && l->room == room)
        return false;
    snprintf(l->text, sizeof l->text, "%s", text);
    l->scale = scale;
    l->room = room;
    return true;
}

static void draw_panel(viewer *v, double scale) {
    label *l = &v->labels[DRAWING_PANEL];
    if (l->width == 0 || l->scale != scale || v->clock >= v->panel_at + PANEL_SECONDS) {
        view_row rows[PANEL_ROWS];
        view_drawing drawing = view_draw_panel(rows, fill_panel(v, rows), scale);
        l->scale = scale;
        v->panel_at = v->clock;
        upload(v, DRAWING_PANEL, &drawing);
    }
    put(v, DRAWING_PANEL, (int)(12 * scale), (int)(12 * scale));
}

/* A line whose box is centerd at x, its lower end at y. */
static void draw_line(viewer *v, int index, const char *text, double scale, int room, double x,
                      double y) {
    label *l = &v->labels[index];
    if (outdated(l, text, scale, room)) {
        view_drawing drawing = view_draw_message(text, room, scale);
        upload(v, index, &drawing);
    }
    put(v, index, (int)(x - 0.5 * l->width), (int)(y - l->height));
}

static void draw_sides(viewer *v, double scale) {
    const view_settings *d = v->drawn;
    char text[96];
    if (d->split != GPU_SPLIT_DIVIDED)
        return;
    const double middle = (double)d->divider * d->width, gap = 10 * scale;
    for (int side = 0; side < 2; side++) {
        const int index = side ? DRAWING_RIGHT : DRAWING_LEFT;
        describe_look(&d->looks[side], text, sizeof text);
        /* its width is known once it is drawn */
        draw_line(v, index, text, scale, d->width, -d->width, 0);
        const double half = 0.5 * v->labels[index].width + gap;
        put(v, index, (int)(middle + (side ? half : -half) - 0.5 * v->labels[index].width),
            (int)(d->height - 14 * scale - v->labels[index].height));
    }
}

static void draw_ring(viewer *v, double scale) {
    const view_settings *d = v->drawn;
    double x, y, pixels;
    label *l = &v->labels[DRAWING_RING];
    if (v->state.selected < 0 || (size_t)v->state.selected >= d->light_count)
        return;
    const scene_light *light = &d->lights[v->state.selected];
    if (!view_project(&d->camera, d->width, d->height, light->emitter.position, &x, &y, &pixels))
        return;
    const double radius = (double)light->emitter.radius * pixels + 5 * scale;
    if (!(radius < d->width))
        return;
    char text[32];
    snprintf(text, sizeof text, "%.0f", radius);
    if (outdated(l, text, scale, 0)) {
        view_drawing drawing = view_draw_ring(radius, scale);
        upload(v, DRAWING_RING, &drawing);
    }
    put(v, DRAWING_RING, (int)lround(x - 0.5 * l->width), (int)lround(y - 0.5 * l->height));
}

static void draw_help(viewer *v, double scale) {
    label *l = &v->labels[DRAWING_HELP];
    char text[48];
    snprintf(text, sizeof text, "%d %d", v->drawn->width, v->drawn->height);
    if (outdated(l, text, scale, 0)) {
        view_drawing drawing = view_draw_help(v->drawn->width, v->drawn->height, scale);
        upload(v, DRAWING_HELP, &drawing);
    }
    put(v, DRAWING_HELP, (v->drawn->width - l->width) / 2, (v->drawn->height - l->height) / 2);
}

static void draw_over(viewer *v, const char *announcement) {
    const double scale = view_window_scale(v->window);
    const char *message = announcement ? announcement : v->state.message;
    draw_ring(v, scale);
    if (v->state.overlay && !v->state.help) {
        draw_sides(v, scale);
        draw_panel(v, scale);
    }
    if (v->state.help)
        draw_help(v, scale);
    if (message[0])
        draw_line(v, DRAWING_MESSAGE, message, scale, (int)(0.9 * v->drawn->width),
                  0.5 * v->drawn->width, v->drawn->height - 56 * scale);
}

static void show(viewer *v, const char *announcement) {
    const double began = view_window_clock();
    view_stage_show(v->stage, v->drawn, (float)(2 * view_window_scale(v->window)));
    draw_over(v, announcement);
    view_window_swap(v->window);
    v->show_seconds = view_window_clock() - began;
}

/* --- frames -------------------------------------------------------------------------------------
 */

/* A fixed step of time a frame, so that the same script gives the same images. */
static bool steps_time(const viewer *v) {
    return v->script_next < v->script.count || v->state.recording;
}

/* Settings that cannot be drawn are taken back, with a line that says why. */
static bool take_back(viewer *v, const cli_error *error) {
    view_say(&v->state, "%s", error->text);
    if (v->good->width == 0)
        return false;
    const int width = v->state.now.width, height = v->state.now.height;
    memcpy(v->state.now.looks, v->good->looks, sizeof v->good->looks);
    memcpy(v->state.now.materials, v->good->materials, sizeof v->good->materials);
    v->state.now.material_count = v->good->material_count;
    v->state.now.split = v->good->split;
    v->state.now.camera = v->good->camera;
    v->state.now.width = width;
    v->state.now.height = height;
    v->fresh = true;
    return true;
}

/* How coarse a draft has to be, from how long the last one took. */
static void adapt(viewer *v, double seconds) {
    const gpu_times *t = &v->figures.times;
    const double finer = v->divisor > 1 ? (double)v->divisor / (v->divisor - 1) : 1;
    /* the window costs the same however many pixels the draft has */
    const double of_pixels = seconds - v->show_seconds - (v->moves ? 1e-3 * t->gbuffer : 0);
    const double expected = seconds + of_pixels * (finer * finer - 1);
    const int before = v->divisor;
    v->frame_seconds = v->frame_seconds > 0 ? 0.7 * v->frame_seconds + 0.3 * seconds : seconds;
    /* twice too slow: a first frame of its size, or of a camera that has come to rest, is slower */
    if (fmin(seconds, v->slow_seconds) > MOVING_SECONDS * 1.1 && v->divisor < DIVISOR_MAX)
        v->divisor++;
    else if (v->divisor > 1 && expected < 0.9 * MOVING_SECONDS)
        v->divisor--;
    v->slow_seconds = v->divisor == before ? seconds : 0;
}

/* Draws what has changed, or refines what has not; false if there was nothing to do. */
static bool draw(viewer *v, bool *worked, cli_error *error) {
    const bool changed = v->fresh || memcmp(v->shown, v->drawn, sizeof *v->shown) != 0;
    const bool draft = changed && !steps_time(v) && v->divisor > 1 && v->good->width > 0;
    *worked = false;
    if (changed) {
        v->moves = memcmp(&v->shown->camera, &v->drawn->camera, sizeof v->drawn->camera) != 0;
        memcpy(v->drawn, v->shown, sizeof *v->drawn);
        v->changed_at = v->clock;
        v->sample = draft ? -1 : 0;
    } else if (v->sample >= v->drawn->samples - 1 ||
               (!steps_time(v) && v->clock < v->changed_at + STILL_SECONDS)) {
        return true;
    } else {
        v->sample++;
    }
    v->fresh = false;
    *worked = true;
    if (!(draft ? view_stage_draft(v->stage, v->drawn, v->divisor, &v->figures, error)
                : view_stage_refine(v->stage, v->drawn, v->sample, &v->figures, error)))
        return false;
    memcpy(v->good, v->drawn, sizeof *v->good);
    return true;
}

/* Whether the drawings over the image have to change; notes what they show then. */
static bool changes_over(viewer *v) {
    const view_state *s = &v->state;
    drawn_over now;
    memset(&now, 0, sizeof now);
    now.help = s->help;
    now.overlay = s->overlay;
    now.playing = s->playing;
    now.selected = s->selected;
    memcpy(now.message, s->message, strlen(s->message));
    const bool changed = memcmp(&now, &v->over, sizeof now) != 0;
    v->over = now;
    return changed;
}

/* *worked: whether there was anything to show. */
static bool draw_frame(viewer *v, bool *worked, cli_error *error) {
    const double began = view_window_clock();
    const bool first = v->good->width == 0;
    view_shown(&v->state, v->shown);
    const char *slow = view_stage_pending(v->stage, v->shown);
    if (slow && !v->waiting && !first && !steps_time(v)) {
        v->waiting = true;
        show(v, slow);
        *worked = true;
        return true;
    }
    v->waiting = false;
    if (!draw(v, worked, error))
        return take_back(v, error);
    const bool moving = *worked && v->changed_at == v->clock && !slow && !first;
    if (v->state.recording && !record_frame(v, error))
        return false;
    const bool redraw = v->state.wishes.redraw;
    v->state.wishes.redraw = false;
    if (!changes_over(v) && !*worked && !redraw)
        return true;
    *worked = true;
    show(v, NULL);
    if (first)
        v->divisor = 2;
    else if (moving)
        adapt(v, view_window_clock() - began);
    return true;
}

static bool expose(viewer *v, cli_error *error) {
    view_shown(&v->state, v->shown);
    return view_stage_expose(v->stage, v->shown, &v->state.now.exposure, error);
}

/* --- wishes -------------------------------------------------------------------------------------
 */

static bool open_graphics(viewer *v, cli_error *error) {
    char title[VIEW_PATH_SIZE + 16];
    snprintf(title, sizeof title, "%s - Lampion", v->options->settings.scene);
    v->window = view_window_open(title, v->state.now.width, v->state.now.height, &v->state, error);
    memset(v->labels, 0, sizeof v->labels);
    v->fresh = true;
    return v->window && gpu_context_adopt(&v->context, error) &&
           (v->stage = view_stage_create(&v->context, v->world, error));
}

static void close_graphics(viewer *v) {
    view_stage_destroy(v->stage);
    view_window_close(v->window);
    v->stage = NULL;
    v->window = NULL;
}

static bool restart(viewer *v, cli_error *error) {
    close_graphics(v);
    if (!open_graphics(v, error))
        return false;
    view_say(&v->state, "The graphics were started anew");
    return true;
}

static bool grant_wishes(viewer *v, cli_error *error) {
    const view_wishes wishes = v->state.wishes;
    v->state.wishes = (view_wishes) { .quit = wishes.quit, .redraw = wishes.redraw };
    if (wishes.restart && !restart(v, error))
        return false;
    if (wishes.reload)
        reload(v);
    if (wishes.fullscreen)
        view_window_toggle_fullscreen(v->window);
    if (wishes.expose && !expose(v, error))
        view_say(&v->state, "%s", error->text);
    if (wishes.record)
        toggle_recording(v);
    return !wishes.shot || take_shot(v, NULL, error);
}

/* --- the loop -----------------------------------------------------------------------------------
 */

/* Plays what is due; a size goes through the window. */
static bool play_script(viewer *v, cli_error *error) {
    while (v->script_next < v->script.count) {
        const view_script_line *line = &v->script.lines[v->script_next];
        const bool early = line->kind == VIEW_SCRIPT_SHOT && v->good->width == 0;
        if (line->seconds > v->clock || early)
            return true;
        v->script_next++;
        if (line->kind == VIEW_SCRIPT_SHOT) /* what follows belongs to the next frame */
            return take_shot(v, line->text, error);
        if (line->event.kind == VIEW_SIZE)
            view_window_resize(v->window, (int)line->event.x, (int)line->event.y);
        else
            view_handle(&v->state, &line->event);
        if (v->state.wishes.shot)
            return true;
    }
    return true;
}

static void pass_time(viewer *v, double *before) {
    const double now = view_window_clock();
    const double passed = steps_time(v) ? 1 / (double)v->options->fps : now - *before;
    *before = now;
    v->clock += passed;
    view_advance(&v->state, passed < 0.5 || steps_time(v) ? passed : 0.5);
}

static bool loop(viewer *v, cli_error *error) {
    double before = view_window_clock();
    bool busy = true, worked;
    while (!v->state.wishes.quit && (v->options->frames == 0 || v->frame < v->options->frames)) {
        view_window_take_events(v->window, busy || steps_time(v) ? 0 : 0.05);
        pass_time(v, &before);
        if (!play_script(v, error))
            return false;
        watch(v);
        if (gpu_context_lost())
            v->state.wishes.restart = true;
        if (!grant_wishes(v, error))
            return false;
        int width, height;
        busy = worked = false;
        if (view_window_size(v->window, &width, &height)) {
            view_handle(&v->state, &(view_event) { .kind = VIEW_SIZE, .x = width, .y = height });
            if (!draw_frame(v, &worked, error))
                return false;
            busy = worked || v->sample < v->drawn->samples - 1;
        }
        if (!worked && !steps_time(v))
            continue;
        v->frame++;
        if (v->options->state && !write_state(v, error))
            return false;
    }
    return true;
}

static bool open_viewer(viewer *v, cli_error *error) {
    const view_options *o = v->options;
    view_settings settings = o->settings;
    const int size[2] = { settings.width, settings.height };
    v->shown = calloc(1, sizeof *v->shown);
    v->drawn = calloc(1, sizeof *v->drawn);
    v->good = calloc(1, sizeof *v->good);
    if (!v->shown || !v->drawn || !v->good)
        return cli_fail(error, NULL, "out of memory");
    if (o->script && !view_script_read(o->script, &v->script, error))
        return false;
    v->seen = v->candidate = version_of(settings.scene);
    v->world = load_scene(o, error);
    if (!v->world ||
        (o->camera_wanted &&
         !scene_place_camera(v->world, &o->camera, size, &settings.camera, error)) ||
        !view_state_open(v->world, &settings, o->animate, &v->state, error))
        return false;
    if (o->keep_lights) {
        memcpy(v->state.now.lights, settings.lights, sizeof settings.lights);
        v->state.now.light_count = settings.light_count;
        v->state.lights_edited = true;
        for (size_t i = 0; i < settings.light_count; i++)
            v->state.numbers[i] = i;
        v->state.next_number = settings.light_count;
    }
    if (o->record && mkdir(o->record, 0777) != 0 && errno != EEXIST)
        return cli_fail(error, o->record, "cannot be made: %s", strerror(errno));
    if (o->record)
        snprintf(v->record, sizeof v->record, "%s", o->record);
    v->state.recording = o->record != NULL;
    v->divisor = 1;
    if (!open_graphics(v, error))
        return false;
    if (o->expose && !expose(v, error))
        return false;
    v->state.now.exposure *= o->expose ? o->settings.exposure : 1;
    if (!o->script && !o->record)
        view_say(&v->state, "F1 or ? shows all keys");
    return true;
}

bool view_run(const view_options *options, cli_error *error) {
    viewer *v = calloc(1, sizeof *v);
    if (!v)
        return cli_fail(error, NULL, "out of memory");
    v->options = options;
    const bool ok = open_viewer(v, error) && loop(v, error);
    close_graphics(v);
    view_window_end();
    view_state_close(&v->state);
    view_script_free(&v->script);
    free_scene(v->world);
    free(v->shown);
    free(v->drawn);
    free(v->good);
    free(v);
    return ok;
}
