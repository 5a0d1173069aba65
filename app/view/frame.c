/* SPDX-License-Identifier: MIT */
/* frame.c - draws an image as finely as time allows. */
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <string.h>

#define MOVING_SECONDS 0.060 /* for a frame while things move */
#define STILL_SECONDS  0.12  /* from the last change until refinement begins */
enum { DIVISOR_MAX = 6 };

bool view_steps_time(const viewer *v) {
    return v->script_next < v->script.count || v->state.recording;
}

/* Shows the image, and over it the interface's last frame. */
static void show(viewer *v) {
    const double began = view_window_clock();
    view_compositor_show(v->compositor, v->drawn, (float)(2 * v->state.scale));
    ui_draw();
    v->over = v->laid;
    view_window_swap(v->window);
    v->show_seconds = view_window_clock() - began;
}

/* Restores the shading settings of the last image that could be drawn. */
static void shade_as_before(const viewer *v, view_settings *settings) {
    memcpy(settings->shading, v->good->shading, sizeof v->good->shading);
    memcpy(settings->materials, v->good->materials, sizeof v->good->materials);
    settings->material_count = v->good->material_count;
    settings->split = v->good->split;
    settings->shadows = v->good->shadows;
    settings->bounces = v->good->bounces;
    if (strcmp(settings->scene, v->good->scene) != 0)
        return;
    memcpy(settings->environment, v->good->environment, sizeof v->good->environment);
    settings->environment_rotation = v->good->environment_rotation;
    settings->environment_strength = v->good->environment_strength;
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
    } else if (v->sample >= v->drawn->samples - 1 ||
               (!view_steps_time(v) && v->clock < v->changed_at + STILL_SECONDS)) {
        return true;
    } else {
        v->sample++;
    }
    v->fresh = false;
    *worked = true;
    if (!(preview
              ? view_compositor_preview(v->compositor, v->drawn, v->divisor, &v->statistics, error)
              : view_compositor_refine(v->compositor, v->drawn, v->sample, &v->statistics, error)))
        return false;
    memcpy(v->good, v->drawn, view_settings_size(v->drawn));
    return true;
}

/* Whether another process does the slow work. Tables that will not fit are not made; drawing
 * reports that. */
static bool is_baking(viewer *v) {
    const view_settings *s = v->shown;
    return s->material_count > 0 &&
           (view_bakes(&v->baking, s) || view_compositor_fits(v->compositor, s)) &&
           view_bake(&v->baking, s);
}

bool view_draw_frame(viewer *v, bool *worked, base_error *error) {
    const double began = view_window_clock();
    const bool first = v->good->width == 0;
    view_shown(&v->state, v->shown);
    const bool waits = !first && !view_steps_time(v);
    const char *slow = waits ? view_compositor_pending(v->compositor, v->shown) : NULL;
    const bool bakes = slow && is_baking(v);
    if (bakes) { /* until it has finished, shade as before */
        shade_as_before(v, v->shown);
    } else if (slow && !v->waiting) {
        v->waiting = true;
        view_lay_out(v, slow, false);
        show(v);
        *worked = true;
        return true;
    }
    v->waiting = false;
    if (!draw(v, worked, error))
        return take_back(v, error);
    const bool moving = *worked && v->changed_at == v->clock && (!slow || bakes) && !first;
    if (v->state.recording && !view_record_frame(v, error))
        return false;
    const bool redraw = v->state.requests.redraw;
    v->state.requests.redraw = false;
    view_lay_out(v, bakes ? slow : NULL, *worked);
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
