/* SPDX-License-Identifier: MIT */
/* input.c - which events are the interface's, and which the image's. */
#include "app/view/ui.h"
#include "app/view/viewer.h"

#include <math.h>
#include <string.h>

/* Lays the interface out where the pointer is now, if it moved since. */
static void follow_pointer(viewer *v) {
    if (v->pointed)
        view_lay_out(v, NULL, false);
    v->pointed = false;
}

/* Moves the pointer of the image; while it is over the interface, it points at the middle of what
 * is seen of the image. */
static void move(viewer *v, const view_event *event) {
    const bool outside = v->state.drag == VIEW_DRAG_SIDEBAR ||
                         (v->state.drag == VIEW_DRAG_NONE && ui_covers(event->x, event->y));
    ui_move(event->x, event->y);
    v->pointed = true;
    if (outside)
        view_handle(&v->state, &(view_event) { .kind = VIEW_MOVE,
                                               .x = 0.5 * v->uncovered,
                                               .y = 0.5 * v->state.now.height });
    else
        view_handle(&v->state, event);
}

/* A button that is pressed over the interface stays its own until it is released. */
static void press(viewer *v, const view_event *event, bool covered) {
    follow_pointer(v);
    if (covered)
        v->state.drag = VIEW_DRAG_SIDEBAR;
    ui_press((int)event->button, true);
    view_lay_out(v, NULL, false);
    if (!covered)
        view_handle(&v->state, event);
}

static void release(viewer *v, const view_event *event) {
    follow_pointer(v);
    ui_press((int)event->button, false);
    view_lay_out(v, NULL, false);
    view_handle(&v->state, event);
}

static void scroll(viewer *v, const view_event *event) {
    follow_pointer(v);
    ui_scroll(event->y);
    view_lay_out(v, NULL, false);
}

static bool is_character(const char *key) {
    return key[1] == '\0' || (unsigned char)key[0] >= 0x80;
}

/* Gives typed text, or a key, to the active field; a key without a meaning there is the image's. */
static void type(viewer *v, const view_event *event) {
    const char *text = event->text;
    if (event->kind == VIEW_TYPE || is_character(text) || strcmp(text, "space") == 0) {
        ui_type(strcmp(text, "space") == 0 ? " " : text);
    } else if (ui_key(text, true)) {
        view_lay_out(v, NULL, false);
        ui_key(text, false);
    } else {
        view_handle(&v->state, event);
        return;
    }
    view_lay_out(v, NULL, false);
    if (!ui_takes_text())
        view_keep(&v->state);
}

/* Takes what there is to do while the first scene is read: to cancel it. */
static void take_waiting(viewer *v, const view_event *event) {
    const view_key *row = event->kind == VIEW_KEY   ? view_find_key(event->text)
                          : event->kind == VIEW_ACT ? view_find_action(event->text)
                                                    : NULL;
    if (event->kind == VIEW_MOVE)
        ui_move(event->x, event->y);
    if (event->kind == VIEW_PRESS || event->kind == VIEW_RELEASE) {
        view_lay_out(v, NULL, false);
        ui_press((int)event->button, event->kind == VIEW_PRESS);
        view_lay_out(v, NULL, false);
    }
    if (row && view_is_end(row))
        v->state.requests.quit = true;
}

void view_take_event(void *to, const view_event *event) {
    viewer *v = to;
    if (!v->state.world) {
        take_waiting(v, event);
        return;
    }
    const bool covered =
        v->state.drag == VIEW_DRAG_SIDEBAR || (v->state.drag == VIEW_DRAG_NONE && ui_covered());
    const bool typed = event->kind == VIEW_KEY || event->kind == VIEW_TYPE;
    if (isinf(v->state.message_until) &&
        (typed || event->kind == VIEW_HOLD || event->kind == VIEW_PRESS))
        v->state.message_until = 0;
    if (event->kind == VIEW_MOVE)
        move(v, event);
    else if (event->kind == VIEW_PRESS)
        press(v, event, covered);
    else if (event->kind == VIEW_RELEASE)
        release(v, event);
    else if (event->kind == VIEW_SCROLL && covered)
        scroll(v, event);
    else if (typed && ui_takes_text())
        type(v, event);
    else if (event->kind != VIEW_HOLD || !ui_takes_text())
        view_handle(&v->state, event);
}
