/* SPDX-License-Identifier: MIT */
/* view.h - a viewer's state without its window, and events for it. */
#ifndef TESTS_PROGRAM_VIEW_H
#define TESTS_PROGRAM_VIEW_H

#include "app/view/state.h"

#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

#define CHECK_NEAR(expected, actual, bound)                                                        \
    CHECK_WITHIN(fabs((double)(actual) - (double)(expected)), bound)

/* Loaded once, because no test changes them. */
static scene world;
static view_tree *tree;
static view_state state;

static int open_state(void **unused) {
    (void)unused;
    base_error error;
    static view_settings settings;
    memset(&settings, 0, sizeof settings);
    if (!world.name && !scene_load("builtin:ball", NULL, &world, &error))
        return -1;
    strcpy(settings.scene, "builtin:ball");
    settings.width = 640;
    settings.height = 480;
    settings.samples = 4;
    settings.exposure = 1;
    settings.divider = 0.5f;
    settings.shading[0] = settings.shading[1] =
        (view_shading) { METHOD_ZONAL, 10, LMP_WINDOW_NONE };
    settings.camera = (scene_camera) { .eye = { 0, 0, 10 }, .up = { 0, 1, 0 }, .fov = 1 };
    tree = tree ? tree : view_tree_begin(&world, &error);
    if (!tree || !view_tree_wait(tree) ||
        !view_state_open(&world, tree, &settings, NULL, &state, &error))
        return -1;
    for (int k = 0; k < 3; k++)
        state.now.camera.target[k] = 0.5f * (world.minimum[k] + world.maximum[k]);
    return 0;
}

static int close_state(void **unused) {
    (void)unused;
    view_state_close(&state);
    return 0;
}

static inline void key(const char *name) {
    view_handle(&state, &(view_event) { .kind = VIEW_KEY, .text = name });
}

static inline void at(double x, double y) {
    view_handle(&state, &(view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
}

static inline void button(view_event_kind kind, view_button which, bool shift) {
    view_handle(&state, &(view_event) { .kind = kind, .button = which, .shift = shift });
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, open_state, close_state)

#endif
