/* SPDX-License-Identifier: MIT */
/* viewer.c - the viewer's loop: events, time, requests. */
#include "app/view/view.h"

#include "app/base/error.h"
#include "app/base/timing.h"
#include "app/view/nodes.h"
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define WAITING_SECONDS 0.3 /* for the first scene, without a window */

/* --- the window's graphics -------------------------------------------------------------------- */

static void close_graphics(viewer *v) {
    ui_close();
    view_compositor_destroy(v->compositor);
    view_window_close(v->window);
    v->compositor = NULL;
    v->window = NULL;
}

static bool open_window(viewer *v, base_error *error) {
    v->window = view_window_open("Lampion", v->state.now.width, v->state.now.height,
                                 view_take_event, v, error);
    if (!v->window)
        return false;
    view_show_title(v);
    v->state.scale = view_window_scale(v->window);
    return gpu_context_adopt(&v->context, error) &&
           (ui_open(true, view_window_copy, view_window_paste) ||
            base_fail(error, NULL, "the functions of libGL cannot be loaded"));
}

/* Prepares to draw the scene, in the window that is there or a new one. */
static bool open_graphics(viewer *v, base_error *error) {
    if (!v->window && !open_window(v, error))
        return false;
    view_compositor_destroy(v->compositor);
    v->compositor = view_compositor_create(&v->context, v->part, v->tree, v->work, error);
    v->fresh = true;
    v->state.scale = view_window_scale(v->window);
    return v->compositor;
}

/* Opens the window if the first scene takes long to read, and shows how far it is. */
static void wait_for_scene(viewer *v) {
    static const scene nothing = { .name = "" };
    base_error ignored; /* it is found again when there is something to show */
    if (timing_now() < v->load_began + WAITING_SECONDS)
        return;
    if (!v->window &&
        !(open_window(v, &ignored) && (v->compositor = view_compositor_create(
                                           &v->context, &nothing, NULL, v->work, &ignored)))) {
        close_graphics(v);
        v->load_began = HUGE_VAL;
        return;
    }
    view_window_take_events(v->window, 0);
    v->percent = atomic_load(&v->loading.percent);
    if (v->state.requests.quit)
        atomic_store(&v->loading.cancelled, true);
    int width, height;
    if (!view_window_size(v->window, &width, &height))
        return;
    v->state.now.width = width;
    v->state.now.height = height;
    view_lay_out(v, NULL, false);
    if (v->laid == v->over)
        return;
    view_images_show(view_compositor_images(v->compositor), &v->state.now, 0, 0);
    ui_draw();
    v->over = v->laid;
    view_window_swap(v->window);
}

/* Goes on while something else is in work. */
static void go_on(void *of) {
    viewer *v = of;
    if (v->state.world)
        view_go_on(v);
    else
        wait_for_scene(v);
}

static bool restart(viewer *v, base_error *error) {
    close_graphics(v);
    if (!open_graphics(v, error))
        return false;
    view_say(&v->state, "The graphics were started again");
    return true;
}

/* Says which lights make what is under the pointer. */
static void find_shares(viewer *v) {
    view_state *s = &v->state;
    char text[VIEW_MESSAGE_SIZE];
    base_error error;
    if (!(s->x >= 0 && s->y >= 0 && s->x < s->now.width && s->y < s->now.height)) {
        view_say(s, "Point at a surface");
        return;
    }
    view_shown(s, v->shown);
    if (view_shares_find(v->compositor, v->shown, view_side(s), (int)s->x, (int)s->y, &s->shares,
                         &error)) {
        view_shares_describe(&s->shares, text, sizeof text);
        view_say(s, "%s", text);
    } else {
        view_say(s, "%s", error.text);
    }
}

static bool fulfill_requests(viewer *v, base_error *error) {
    const view_requests requests = v->state.requests;
    v->state.requests = (view_requests) { .quit = requests.quit, .redraw = requests.redraw };
    if (requests.cancel)
        view_cancel(v);
    if (requests.restart && !restart(v, error))
        return false;
    if (requests.reload)
        view_reload(v);
    if (requests.nodes)
        view_change_part(v);
    if (requests.resume)
        view_resume_session(v);
    if (requests.fullscreen)
        view_window_toggle_fullscreen(v->window);
    if (requests.expose && !view_expose(v, error))
        view_say(&v->state, "%s", error->text);
    if (requests.save)
        view_export_lights(v);
    if (requests.copy)
        view_export_scene(v);
    if (requests.shares)
        find_shares(v);
    if (requests.record)
        view_toggle_recording(v);
    if (requests.command && !view_copy_command(v, error))
        view_say(&v->state, "%s", error->text);
    return !requests.shot || view_take_shot(v, NULL, error);
}

/* --- the loop --------------------------------------------------------------------------------- */

/* Plays the script's events that are due; a size goes through the window. */
static bool play_script(viewer *v, base_error *error) {
    while (v->script_next < v->script.count) {
        const view_script_line *line = &v->script.lines[v->script_next];
        const bool early = line->kind == VIEW_SCRIPT_SHOT && v->good->width == 0;
        if (line->seconds > v->clock || early)
            return true;
        v->script_next++;
        if (line->kind == VIEW_SCRIPT_SHOT) /* later events belong to the next frame */
            return view_take_shot(v, line->text, error);
        if (line->kind == VIEW_SCRIPT_EXPORT) {
            if (!view_export(v, line->text, error))
                return false;
        } else if (line->event.kind == VIEW_SIZE)
            view_window_resize(v->window, (int)line->event.x, (int)line->event.y);
        else
            view_take_event(v, &line->event);
        if (v->state.requests.shot || v->state.requests.command)
            return true;
    }
    return true;
}

static bool loop(viewer *v, base_error *error) {
    bool busy = true, worked;
    while (!v->state.requests.quit && (v->options->frames == 0 || v->frame < v->options->frames)) {
        v->state.scale = view_window_scale(v->window);
        view_window_take_events(v->window, busy || view_steps_time(v) ? 0 : 0.05);
        view_pass_time(v);
        if (!play_script(v, error))
            return false;
        view_watch(v);
        if (gpu_context_lost())
            v->state.requests.restart = true;
        if (!fulfill_requests(v, error))
            return false;
        int width, height;
        busy = worked = false;
        if (view_window_size(v->window, &width, &height)) {
            view_handle(&v->state, &(view_event) { .kind = VIEW_SIZE, .x = width, .y = height });
            if (!view_draw_frame(v, &worked, error))
                return false;
            busy = worked || v->fresh || (!v->held && v->sample < v->drawn->samples - 1);
        }
        if (!worked && !view_steps_time(v))
            continue;
        v->frame++;
        if (v->options->state && !view_write_state(v, error))
            return false;
    }
    return true;
}

static bool open_viewer(viewer *v, base_error *error) {
    const view_options *o = v->options;
    const int size[2] = { o->settings.width, o->settings.height };
    v->shown = calloc(1, sizeof *v->shown);
    v->drawn = calloc(1, sizeof *v->drawn);
    v->good = calloc(1, sizeof *v->good);
    if (!v->shown || !v->drawn || !v->good)
        return base_fail(error, NULL, "out of memory");
    view_settings *const first = v->shown; /* allocated, because it is too large for the stack */
    memcpy(first, &o->settings, sizeof *first);
    if (o->script && !view_script_read(o->script, &v->script, error))
        return false;
    v->seen = v->candidate = view_version_of(first->scene);
    memcpy(&v->state.now, first, sizeof *first); /* the window's size and title */
    v->work = view_work_begin(go_on, v, error);
    v->world = v->work ? view_load_scene(v, o->settings.scene, &o->load, &o->lights, error) : NULL;
    if (!v->world || v->state.requests.quit)
        return v->state.requests.quit;
    view_settings_rebase(first, v->world->origin);
    if (o->camera_wanted && !scene_place_camera(v->world, &o->camera, size, &first->camera, error))
        return false;
    first->camera.near = first->camera.far = 0; /* it may fly past the file's planes */
    v->part = view_part_make(v->world, first, error);
    v->tree = v->part ? view_tree_begin(v->part, error) : NULL;
    if (!v->tree)
        return false;
    if (!view_state_open(v->world, v->tree, first, o->animate, &v->state, error))
        return false;
    if (!view_choose_environment(v, error))
        return false;
    if (o->keep_lights) {
        view_put_lights(&v->state, first->lights, first->light_count);
        view_history_keep(&v->state.history, &v->state.now, v->state.numbers);
    }
    if (o->record && mkdir(o->record, 0777) != 0 && errno != EEXIST)
        return base_fail(error, o->record, "cannot be made: %s", strerror(errno));
    if (o->record)
        snprintf(v->record, sizeof v->record, "%s", o->record);
    v->state.recording = o->record != NULL;
    v->divisor = 1;
    if (!open_graphics(v, error))
        return false;
    v->passed_at = view_window_clock();
    v->state.sidebar =
        view_is_interactive(v) && v->state.now.width >= 3 * VIEW_SIDEBAR_WIDTH * v->state.scale;
    if (o->expose && !view_expose(v, error))
        return v->state.requests.quit;
    v->state.now.exposure *= o->expose ? o->settings.exposure : 1;
    view_begin_session(v);
    return true;
}

bool view_run(const view_options *options, base_error *error) {
    viewer *v = calloc(1, sizeof *v);
    if (!v)
        return base_fail(error, NULL, "out of memory");
    v->options = options;
    const bool ok = open_viewer(v, error) && loop(v, error);
    if (ok && v->state.world)
        view_keep_session(v);
    view_baking_stop(&v->baking);
    view_work_end(v->work);
    close_graphics(v);
    view_window_end();
    view_state_close(&v->state);
    view_script_free(&v->script);
    view_tree_end(v->tree);
    view_part_free(v->part);
    view_free_scene(v->world);
    free(v->shown);
    free(v->drawn);
    free(v->good);
    free(v);
    return ok;
}
