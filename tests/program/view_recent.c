/* SPDX-License-Identifier: MIT */
/* What the viewer remembers from one run to the next. */
#include "tests/program/folder.h"
#include "tests/program/viewer.h"

#include <sys/stat.h>
#include <unistd.h>

/* Begins anew with a scene, as a run does. */
static void open_scene(const char *name) {
    strcpy(v.state.now.scene, name);
    v.state.message[0] = '\0';
    v.state.message_until = 0;
    v.state.lights_edited = false;
    view_begin_session(&v);
}

static void advance(double seconds) {
    view_advance(&v.state, seconds);
}

/* The very first run tells how to begin until a key or a click, later ones do not. */
static void how_to_begin_is_told_once(void **unused) {
    (void)unused;
    open_scene("builtin:ball");
    assert_non_null(strstr(v.state.message, "F1"));
    take((view_event) { .kind = VIEW_MOVE, .x = 300, .y = 300 });
    advance(1000);
    assert_non_null(strstr(v.state.message, "F1"));
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
    advance(0);
    assert_string_equal(v.state.message, "");
    open_scene("builtin:ball");
    assert_string_equal(v.state.message, "");
    assert_int_equal(v.recent.count, 1);
}

static void a_script_leaves_nothing_behind(void **unused) {
    (void)unused;
    static const view_options scripted = { .script = "script.txt" };
    v.options = &scripted;
    open_scene("builtin:atrium");
    v.state.lights_edited = true;
    view_keep_session(&v);
    v.options = &options;
    assert_int_equal(v.recent.count, 0);
    open_scene("builtin:atrium");
    view_resume_session(&v);
    assert_non_null(strstr(v.state.message, "Nothing"));
}

/* Files are known by their full names, and a click opens them again. */
static void recent_scenes_are_opened_by_a_click(void **unused) {
    (void)unused;
    char item[600];
    folder_write_text("a.obj", "");
    open_scene(in_folder("a.obj"));
    for (int i = 0; i < 2 * VIEW_RECENT_MAX; i++) {
        char name[64];
        snprintf(name, sizeof name, "builtin:balls:%d", i % (VIEW_RECENT_MAX - 1));
        open_scene(name);
    }
    assert_int_equal(v.recent.count, VIEW_RECENT_MAX);
    assert_string_equal(v.recent.scenes[0], "builtin:balls:1");
    assert_string_equal(v.recent.scenes[VIEW_RECENT_MAX - 1], in_folder("a.obj"));
    view_lay_out(&v, NULL, false);
    click_on("Files");
    click_on("builtin:balls:1##recent"); /* is open */
    assert_false(v.state.requests.reload);
    snprintf(item, sizeof item, "a.obj  %s##recent", folder);
    click_on(item);
    assert_true(v.state.requests.reload);
    assert_string_equal(v.state.other, in_folder("a.obj"));
    open_scene("builtin:shapes");
    for (int i = 0; i < v.recent.count; i++)
        assert_string_not_equal(v.recent.scenes[i], in_folder("a.obj"));
}

/* How a scene was left is kept if anything was done, and comes back as one step of undo. */
static void a_session_is_resumed(void **unused) {
    (void)unused;
    open_scene("builtin:ball");
    const scene_camera first = v.state.now.camera;
    const int moments = v.state.history.count;
    take((view_event) { .kind = VIEW_SET, .text = "lights/1/radius 0.7" });
    take((view_event) { .kind = VIEW_SET, .text = "camera/eye 1, 2, 3" });
    take((view_event) { .kind = VIEW_SET, .text = "exposure 3" });
    view_keep_session(&v);
    v.state.now.camera = first;
    v.state.now.exposure = 1;
    v.state.now.light_count = 1;
    view_keep(&v.state);
    open_scene("builtin:ball");
    view_keep_session(&v); /* nothing was done: the earlier one stays */
    open_scene("builtin:balls");
    view_resume_session(&v);
    assert_int_equal(v.state.now.light_count, 1);
    open_scene("builtin:ball");
    v.state.now.up = SCENE_UP_Z; /* nor where another axis is up */
    view_resume_session(&v);
    assert_int_equal(v.state.now.light_count, 1);
    v.state.now.up = SCENE_UP_Y;
    view_resume_session(&v);
    assert_int_equal(v.state.now.light_count, 2);
    CHECK_NEAR(0.7f, v.state.now.lights[1].emitter.radius, 0);
    CHECK_NEAR(3, v.state.now.exposure, 0);
    CHECK_NEAR(2, v.state.now.camera.eye[1], 0);
    assert_int_equal(v.state.history.count, moments + 3);
    view_undo(&v.state, -1);
    assert_int_equal(v.state.now.light_count, 1);
    view_undo(&v.state, -1);
    view_undo(&v.state, -1);
    CHECK_NEAR(0.25f, v.state.now.lights[1].emitter.radius, 0);
}

/* A damaged state is as none, and a folder that cannot be is no error. */
static void nothing_is_kept_where_that_cannot_be(void **unused) {
    (void)unused;
    folder_write_text("lampion/recent.json", "{ \"recent\": [ 1, \"\", \"x\" ], ");
    open_scene("builtin:ball");
    assert_int_equal(v.recent.count, 1);
    setenv("XDG_STATE_HOME", "/proc/none", 1);
    v.recent.count = 0;
    open_scene("builtin:ball");
    v.state.lights_edited = true;
    view_keep_session(&v);
    view_resume_session(&v);
    assert_non_null(strstr(v.state.message, "Nothing"));
}

/* Each test begins with an empty folder of states. */
static int begin_empty(void **unused) {
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s/lampion'", folder);
    setenv("XDG_STATE_HOME", folder, 1);
    return system(command) != 0 || mkdir(in_folder("lampion"), 0700) != 0 || open_viewer(unused);
}

int main(void) {
#define RECENT(test) cmocka_unit_test_setup_teardown(test, begin_empty, close_viewer)
    const struct CMUnitTest tests[] = {
        RECENT(how_to_begin_is_told_once),
        RECENT(a_script_leaves_nothing_behind),
        RECENT(recent_scenes_are_opened_by_a_click),
        RECENT(a_session_is_resumed),
        RECENT(nothing_is_kept_where_that_cannot_be),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
