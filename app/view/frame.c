/* SPDX-License-Identifier: MIT */
/* frame.c - draws an image as finely as time allows. */
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <string.h>

#define MOVING_SECONDS 0.060 /* for a frame while things move */
#define STILL_SECONDS  0.12  /* from the last change until refinement begins */
#define SLOW_SECONDS   0.25 /* after which progress is told, and what has changed is not finished */
enum { DIVISOR_MAX = 6 };

bool view_steps_time(const viewer *v) {
    return v->script_next < v->script.count || v->state.recording;
}

/* Shows the image, and over it the interface's last frame. */
static void show(viewer *v) {
    const double began = view_window_clock();
    const view_settings *shown = v->good->width > 0 ? v->good : v->shown;
    view_images_show(view_compositor_images(v->compositor), shown, (float)(2 * v->state.scale),
                     v->state.sidebar ? (int)v->uncovered : 0);
    ui_draw();
    v->over = v->laid;
    view_window_swap(v->window);
    v->show_seconds = view_window_clock() - began;
}

/* Restores the shading settings of the last image that could be drawn. */
static void shade_as_before(const viewer *v, view_settings *settings) {
    memcpy(settings->shading, v->good->shading, sizeof v->good->shading);
    settings->materials = v->good->materials;
    settings->split = v->good->split;
    settings->shadows = v->good->shadows;
    settings->bounces = v->good->bounces;
    if (strcmp(settings->scene, v->good->scene) == 0)
        settings->environment = v->good->environment;
}

/* Reverts settings that cannot be drawn, with a message that says why. */
static bool take_back(viewer *v, const base_error *error) {
    view_say(&v->state, "%s", error->text);
    if (v->good->width == 0)
        return false;
    const int width = v->state.now.width, height = v->state.now.height;
    shade_as_before(v, &v->state.now);
    view_settings_rebase(v->good, v->state.now.origin); /* the scene may be another one */
    v->state.now.camera = v->good->camera;
    v->state.now.width = width;
    v->state.now.height = height;
    v->fresh = true;
    return true;
}

/* Adapts the coarseness of previews to how long the last one took. */
static void adapt(viewer *v, double seconds) {
    const render_times *t = &v->statistics.times;
    const double finer = v->divisor > 1 ? (double)v->divisor / (v->divisor - 1) : 1;
    /* the window costs the same however many pixels the preview has */
    const double of_pixels = seconds - v->show_seconds - (v->moves ? 1e-3 * t->surfaces : 0);
    const double expected = seconds + of_pixels * (finer * finer - 1);
    const int before = v->divisor;
    v->frame_seconds = v->frame_seconds > 0 ? 0.7 * v->frame_seconds + 0.3 * seconds : seconds;
    /* only if two frames are too slow: the first frame of a size, or after the camera has stopped,
     * takes longer */
    if (fmin(seconds, v->slow_seconds) > MOVING_SECONDS * 1.1 && v->divisor < DIVISOR_MAX)
        v->divisor++;
    else if (v->divisor > 1 && expected < 0.9 * MOVING_SECONDS)
        v->divisor--;
    v->slow_seconds = v->divisor == before ? seconds : 0;
}

/* Lets an image that was cancelled be begun again, coarser if it was slow. Returns false if drawing
 * failed otherwise. */
static bool begin_again(viewer *v) {
    if (!atomic_load(&view_work_progress(v->work)->cancelled))
        return false;
    v->cancelled++;
    v->fresh = true;
    if (v->sample < 1 && view_window_clock() > v->began + SLOW_SECONDS)
        v->divisor = v->divisor < DIVISOR_MAX / 2 ? 2 * v->divisor : DIVISOR_MAX;
    if (v->sample >= 0)
        v->sample--;
    return true;
}

/* Draws changed settings, or refines the image; *worked is false if there was nothing to do. */
static bool draw(viewer *v, bool *worked, base_error *error) {
    const bool changed = v->fresh || memcmp(v->shown, v->drawn, view_settings_size(v->shown)) != 0;
    const bool preview = changed && !view_steps_time(v) && v->divisor > 1 && v->good->width > 0;
    *worked = false;
    if (changed) {
        v->moves = memcmp(&v->shown->camera, &v->drawn->camera, sizeof v->drawn->camera) != 0;
        memcpy(v->drawn, v->shown, view_settings_size(v->shown));
        v->changed_at = v->clock;
        v->sample = preview ? -1 : 0;
    } else if (v->held || v->sample >= v->drawn->samples - 1 ||
               (!view_steps_time(v) && v->clock < v->changed_at + STILL_SECONDS)) {
        return true;
    } else {
        v->sample++;
    }
    v->fresh = v->held = false;
    v->draws = true;
    v->began = view_window_clock();
    *worked = view_compositor_draw(v->compositor, v->drawn, preview ? v->divisor : 1,
                                   preview ? 0 : v->sample, &v->statistics, error);
    v->draws = false;
    if (!*worked)
        return begin_again(v);
    memcpy(v->good, v->drawn, view_settings_size(v->drawn));
    return true;
}

/* Whether another process does the slow work. Tables that will not fit are not made; drawing
 * reports that. */
static bool is_baking(viewer *v) {
    const view_settings *s = v->shown;
    return s->materials.count > 0 &&
           (view_bakes(&v->baking, s) || view_compositor_fits(v->compositor, s)) &&
           view_bake(&v->baking, s);
}

/* --- while something is in work --------------------------------------------------------------- */

void view_pass_time(viewer *v) {
    const double now = view_window_clock();
    const double passed = view_steps_time(v) ? 1 / (double)v->options->fps : now - v->passed_at;
    v->passed_at = now;
    v->clock += passed;
    view_advance(&v->state, passed < 0.5 || view_steps_time(v) ? passed : 0.5);
}

/* Whether the image in work gives way to another one: a finer one at once, a coarse one if it is
 * slow and can be coarser, for otherwise none would be seen while things move. */
static bool gives_way(viewer *v) {
    const bool coarsest = v->good->width == 0 || (v->sample < 0 && v->divisor == DIVISOR_MAX);
    if (v->sample < 1 && (coarsest || view_window_clock() < v->began + SLOW_SECONDS))
        return false;
    view_shown(&v->state, v->shown);
    if (v->bakes)
        shade_as_before(v, v->shown);
    return memcmp(v->shown, v->drawn, view_settings_size(v->shown)) != 0;
}

/* Whether what is in work must end, for what was requested or because of a change. */
static bool is_cancelled(viewer *v) {
    const view_requests *r = &v->state.requests;
    const view_requests none = { .redraw = r->redraw };
    return r->quit || ((v->shoots || v->loads) && r->cancel) || (v->loads && r->reload) ||
           (v->draws && (memcmp(r, &none, sizeof none) != 0 || gives_way(v)));
}

static int percent_of(const render_progress *progress) {
    const int all = atomic_load(&progress->all), done = atomic_load(&progress->done);
    return all > 0 ? done * 10 / all * 10 : 0; /* so that the window is not drawn too often */
}

void view_go_on(void *of) {
    viewer *v = of;
    render_progress *progress = view_work_progress(v->work);
    base_error ignored; /* the next image's state tells of it again */
    int width, height;
    if (view_steps_time(v))
        return;
    view_window_take_events(v->window, 0);
    view_pass_time(v);
    if (view_window_size(v->window, &width, &height))
        view_handle(&v->state, &(view_event) { .kind = VIEW_SIZE, .x = width, .y = height });
    if (is_cancelled(v)) {
        atomic_store(&progress->cancelled, true);
        atomic_store(&v->loading.cancelled, true);
    }
    v->percent = v->loads                                        ? atomic_load(&v->loading.percent)
                 : view_window_clock() > v->began + SLOW_SECONDS ? percent_of(progress)
                                                                 : 0;
    view_lay_out(v, v->announcement, false);
    if (v->laid != v->over || v->state.requests.redraw) {
        v->state.requests.redraw = false;
        show(v);
        if (v->options->state)
            view_write_state(v, &ignored);
    }
    v->percent = 0;
}

void view_cancel(viewer *v) {
    if (v->bakes) {
        view_baking_stop(&v->baking);
        shade_as_before(v, &v->state.now);
        view_say(&v->state, "Cancelled");
    } else if (v->good->width > 0 && !v->held && (v->fresh || v->sample < v->drawn->samples - 1)) {
        v->fresh = false;
        v->held = true;
        view_say(&v->state, "Cancelled: a change draws the image again");
    } else {
        view_say(&v->state, "Ctrl+Q closes the window");
    }
}

/* --- a frame ---------------------------------------------------------------------------------- */

bool view_draw_frame(viewer *v, bool *worked, base_error *error) {
    const double began = view_window_clock();
    const bool first = v->good->width == 0;
    view_shown(&v->state, v->shown);
    const bool waits = !first && !view_steps_time(v);
    const char *slow = waits ? view_compositor_pending(v->compositor, v->shown) : NULL;
    v->bakes = slow && is_baking(v);
    if (v->bakes) { /* until it has finished, shade as before */
        shade_as_before(v, v->shown);
    } else if (slow && !v->waiting) {
        v->waiting = true;
        view_lay_out(v, slow, false);
        show(v);
        *worked = true;
        return true;
    }
    v->waiting = false;
    v->announcement = slow;
    const bool drawn = draw(v, worked, error);
    v->announcement = NULL;
    if (!drawn)
        return take_back(v, error);
    const bool moving = *worked && v->sample < 1 && (!slow || v->bakes) && !first;
    if (v->state.recording && !view_record_frame(v, error))
        return false;
    const bool redraw = v->state.requests.redraw;
    v->state.requests.redraw = false;
    view_lay_out(v, v->bakes ? slow : NULL, *worked);
    if (v->laid == v->over && !*worked && !redraw)
        return true;
    *worked = true;
    show(v);
    memmove(v->sidebar.ms, v->sidebar.ms + 1, sizeof v->sidebar.ms - sizeof *v->sidebar.ms);
    v->sidebar.ms[VIEW_FRAMES_TOLD - 1] = (float)(1e3 * (view_window_clock() - began));
    if (first)
        v->divisor = 2;
    else if (moving)
        adapt(v, view_window_clock() - began);
    return true;
}

bool view_expose(viewer *v, base_error *error) {
    view_shown(&v->state, v->shown);
    return view_compositor_expose(v->compositor, v->shown, &v->state.now.exposure, error);
}
