/* SPDX-License-Identifier: MIT */
/* The viewer's sidebar: every action by its button, its key and its word in scripts. */
#include "app/view/ui.h"
#include "app/view/viewer.h"
#include "tests/program/folder.h"
#include "tests/program/view.h"

enum { WIDTH = 1280, HEIGHT = 3000 }; /* with room for every button at once */
enum { MIDDLE = (WIDTH - VIEW_SIDEBAR_WIDTH) / 2 };

static viewer v;
static const view_options options = { .fps = 30 };

/* Opens a viewer without graphics, whose interface is laid out all the same. */
static int open_viewer(void **unused) {
    static view_settings drawn;
    if (open_state(unused) != 0)
        return -1;
    v = (viewer) { .options = &options, .state = state, .drawn = &drawn, .scale = 1 };
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
    assert_true(ui_open(false));
    view_lay_out(&v, NULL, false);
    view_take_event(&v, &(view_event) { .kind = VIEW_MOVE, .x = MIDDLE, .y = HEIGHT / 2 });
    return 0;
}

static int close_viewer(void **unused) {
    ui_close();
    state = v.state;
    return close_state(unused);
}

static void take(view_event event) {
    view_take_event(&v, &event);
}

static void click(double x, double y) {
    take((view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
    view_lay_out(&v, NULL, false);
}

static void click_on(const char *name) {
    double x, y;
    if (!ui_find(name, &x, &y))
        fail_msg("%s is not to be seen", name);
    click(x, y);
}

/* --- the table -------------------------------------------------------------------------------- */

/* What an action leaves: settings, and what the state says of the rest. */
typedef struct outcome {
    view_settings now;
    view_requests requests;
    char message[VIEW_MESSAGE_SIZE];
    double seconds;
    int selected, path, camera;
    bool playing, help, overlay, sidebar, walking;
    view_panel_kind panel;
    size_t next_number;
} outcome;

static void note(outcome *o) {
    const view_state *s = &v.state;
    memset(o, 0, sizeof *o);
    memcpy(&o->now, &s->now, sizeof s->now);
    o->requests = s->requests;
    strcpy(o->message, s->message);
    o->seconds = s->seconds;
    o->selected = s->selected;
    o->path = s->path;
    o->camera = s->camera;
    o->playing = s->playing;
    o->help = s->help;
    o->overlay = s->overlay;
    o->sidebar = s->sidebar;
    o->walking = s->walking;
    o->panel = s->panel.kind;
    o->next_number = s->next_number;
}

static void by_key(const view_key *row) {
    take((view_event) { .kind = VIEW_KEY, .text = row->key });
}

static void by_script(const view_key *row) {
    char line[128];
    view_script script;
    base_error error;
    snprintf(line, sizeof line, "0 press \"%s\"\n", row->name);
    folder_write_text("press.txt", line);
    if (!view_script_read(in_folder("press.txt"), &script, &error))
        fail_msg("%s", error.text);
    assert_int_equal(script.count, 1);
    take(script.lines[0].event);
    view_script_free(&script);
}

static void by_button(const view_key *row) {
    const view_key *heading = row;
    while (heading->key || heading->help)
        heading--;
    click_on(heading->shown);
    click_on(row->name);
}

static void every_action_is_the_same_by_button_key_and_script(void **unused) {
    (void)unused;
    void (*const ways[])(const view_key *) = { by_key, by_button, by_script };
    static outcome outcomes[3], untouched;
    int changed = 0, count = 0;
    for (const view_key *row = view_keys; row->key || row->shown; row++) {
        if (!row->name)
            continue;
        for (int way = 0; way < 3; way++) {
            assert_int_equal(open_viewer(NULL), 0);
            note(&untouched);
            ways[way](row);
            note(&outcomes[way]);
            close_viewer(NULL);
            if (memcmp(&outcomes[way], &outcomes[0], sizeof *outcomes) != 0)
                fail_msg("%s: way %d does something else", row->name, way);
        }
        count++;
        changed += memcmp(&outcomes[0], &untouched, sizeof untouched) != 0;
    }
    assert_int_equal(open_viewer(NULL), 0);          /* for the teardown */
    assert_true(count > 50 && changed >= count - 2); /* at the first camera, 24 frames are gone */
}

/* Every key has a name, its own or that of another key that does the same. */
static void every_action_has_one_name(void **unused) {
    (void)unused;
    for (const view_key *row = view_keys; row->key || row->shown; row++) {
        bool named = !row->act || row->name;
        for (const view_key *other = view_keys; other < row; other++) {
            named = named || (other->act == row->act && other->argument == row->argument);
            if (row->name && other->name && strcmp(row->name, other->name) == 0)
                fail_msg("%s is two actions", row->name);
        }
        if (!named)
            fail_msg("%s has no name", row->key);
    }
}

/* --- whose event it is ------------------------------------------------------------------------ */

static void what_happens_over_the_sidebar_does_not_reach_the_image(void **unused) {
    (void)unused;
    const scene_camera before = v.state.now.camera;
    take((view_event) { .kind = VIEW_MOVE, .x = WIDTH - 20, .y = HEIGHT - 20 });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_MOVE, .x = 300, .y = 300 }); /* begun there, it stays there */
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_MOVE, .x = WIDTH - 20, .y = HEIGHT - 20 });
    take((view_event) { .kind = VIEW_SCROLL, .y = 3 });
    assert_memory_equal(&before, &v.state.now.camera, sizeof before);
    assert_int_equal(v.state.selected, 0);
    CHECK_NEAR(MIDDLE, v.state.x, 0); /* of the image that is seen */
    take((view_event) { .kind = VIEW_MOVE, .x = 300, .y = 300 });
    CHECK_NEAR(300, v.state.x, 0);
    take((view_event) { .kind = VIEW_SCROLL, .y = 3 });
    assert_true(memcmp(&before, &v.state.now.camera, sizeof before) != 0);
}

/* What is dragged in the image goes on below the sidebar. */
static void a_drag_of_the_image_stays_the_image_s(void **unused) {
    (void)unused;
    take((view_event) { .kind = VIEW_MOVE, .x = 100, .y = 300 });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_MIDDLE });
    take((view_event) { .kind = VIEW_MOVE, .x = 200, .y = 300 });
    const scene_camera before = v.state.now.camera;
    take((view_event) { .kind = VIEW_MOVE, .x = WIDTH - 50, .y = 300 });
    assert_true(memcmp(&before, &v.state.now.camera, sizeof before) != 0);
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_MIDDLE });
    assert_int_equal(v.state.drag, VIEW_DRAG_NONE);
}

static void the_title_folds_the_sidebar(void **unused) {
    (void)unused;
    double x, y;
    click_on(VIEW_SIDEBAR_TITLE);
    assert_false(v.state.sidebar);
    view_lay_out(&v, NULL, false);
    assert_false(ui_find("Camera", &x, &y));
    take((view_event) { .kind = VIEW_MOVE, .x = WIDTH - 20, .y = HEIGHT - 20 });
    CHECK_NEAR(WIDTH - 20, v.state.x, 0); /* the image is there again */
    click_on(VIEW_SIDEBAR_TITLE);
    view_lay_out(&v, NULL, false);
    assert_true(v.state.sidebar && ui_find("Camera", &x, &y));
}

#undef TEST
#define TEST(function) cmocka_unit_test_setup_teardown(function, open_viewer, close_viewer)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(every_action_is_the_same_by_button_key_and_script),
        TEST(every_action_has_one_name),
        TEST(what_happens_over_the_sidebar_does_not_reach_the_image),
        TEST(a_drag_of_the_image_stays_the_image_s),
        TEST(the_title_folds_the_sidebar),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
