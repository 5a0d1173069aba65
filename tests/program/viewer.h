/* SPDX-License-Identifier: MIT */
/* viewer.h - a viewer without graphics, whose sidebar is laid out all the same, and events for it.
 */
#ifndef TESTS_PROGRAM_VIEWER_H
#define TESTS_PROGRAM_VIEWER_H

#include "app/view/ui.h"
#include "app/view/viewer.h"
#include "tests/program/view.h"

enum { WIDTH = 1280, HEIGHT = 3000 }; /* with room for every button at once */
enum { MIDDLE = (WIDTH - VIEW_SIDEBAR_WIDTH) / 2 };

static viewer v;
static const view_options options = { .fps = 30 };

/* Opens a viewer of a scene that is open. */
static void begin(void) {
    static view_settings drawn;
    static view_ball ball; /* of the last test: another is drawn where another is needed */
    ball = v.sidebar.ball;
    v = (viewer) { .options = &options, .state = state, .drawn = &drawn, .sidebar.ball = ball };
    v.state.now.width = WIDTH;
    v.state.now.height = HEIGHT;
    v.state.now.light_count = 2;
    for (int i = 0; i < 2; i++)
        v.state.now.lights[i] = (scene_light) {
            .emitter = { .position = { (float)i, 3, 0 }, .radius = 0.25f, .radiance = { 4, 2, 1 } }
        };
    v.state.numbers[1] = 1;
    v.state.next_number = 2;
    v.state.selected = 0;
    v.state.sidebar = true;
    v.state.seconds = 1;
    memcpy(&drawn, &v.state.now, view_settings_size(&v.state.now));
    view_keep(&v.state);
    view_lay_out(&v, NULL, false);
    view_take_event(&v, &(view_event) { .kind = VIEW_MOVE, .x = MIDDLE, .y = HEIGHT / 2 });
}

static int open_viewer(void **unused) {
    if (open_state(unused) != 0)
        return -1;
    assert_true(ui_open(false, NULL, NULL));
    begin();
    return 0;
}

static int close_viewer(void **unused) {
    ui_close();
    state = v.state;
    return close_state(unused);
}

static inline void take(view_event event) {
    view_take_event(&v, &event);
}

static inline void click(double x, double y) {
    take((view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
    view_lay_out(&v, NULL, false);
}

static inline void click_on(const char *name) {
    double x, y;
    if (!ui_find(name, &x, &y))
        fail_msg("%s is not to be seen", name);
    click(x, y);
}

#undef TEST
#define TEST(function) cmocka_unit_test_setup_teardown(function, open_viewer, close_viewer)

#endif
