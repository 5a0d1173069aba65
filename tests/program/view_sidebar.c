/* SPDX-License-Identifier: MIT */
/* The viewer's sidebar: every action by its button, its key and its word in scripts. */
#include "app/view/handles.h"
#include "tests/program/folder.h"
#include "tests/program/viewer.h"

#include <jansson.h>
#include <stdlib.h>

/* --- the table -------------------------------------------------------------------------------- */

/* What an action leaves: settings, and what the state says of the rest. */
typedef struct outcome {
    view_settings now;
    view_requests requests;
    char message[VIEW_MESSAGE_SIZE];
    double seconds;
    int selected, path, camera;
    bool playing, help, overlay, sidebar, handles, walking;
    view_panel_kind panel;
    size_t next_number;
    bool muted, solo;
} outcome;

static void note(outcome *o) {
    const view_state *s = &v.state;
    memset(o, 0, sizeof *o);
    memcpy(&o->now, &s->now, sizeof s->now);
    o->requests = s->requests;
    strcpy(o->message, s->message);
    o->seconds = s->seconds;
    o->selected = s->selected;
    o->path = s->paths.at;
    o->camera = s->camera;
    o->playing = s->playing;
    o->help = s->help;
    o->overlay = s->overlay;
    o->sidebar = s->sidebar;
    o->handles = s->handles;
    o->walking = s->walking;
    o->panel = s->panel.kind;
    o->next_number = s->next_number;
    o->muted = s->muted[0];
    o->solo = s->solo;
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
    double x, y;
    if (!ui_find(row->name, &x, &y))
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
            state = v.state;
            close_state(NULL);
            assert_int_equal(open_state(NULL), 0);
            begin();
            note(&untouched);
            ways[way](row);
            note(&outcomes[way]);
            if (memcmp(&outcomes[way], &outcomes[0], sizeof *outcomes) != 0)
                fail_msg("%s: way %d does something else", row->name, way);
        }
        count++;
        changed += memcmp(&outcomes[0], &untouched, sizeof untouched) != 0;
    }
    assert_true(count > 50 && changed >= count - 2); /* two have nothing to do here */
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

/* --- values ----------------------------------------------------------------------------------- */

static void set(const char *line) {
    v.state.message[0] = '\0';
    take((view_event) { .kind = VIEW_SET, .text = line });
}

/* Returns a member of the state's JSON by its path, as text without blanks. */
static const char *member(const char *path) {
    static char text[256], step[64];
    json_t *root = view_settings_to_json(&v.state.now), *at = root;
    for (const char *next = path; next; next = strchr(next, '/') ? strchr(next, '/') + 1 : NULL) {
        snprintf(step, sizeof step, "%.*s", (int)strcspn(next, "/"), next);
        at = json_is_array(at) ? json_array_get(at, strtoul(step, NULL, 10))
                               : json_object_get(at, step);
    }
    char *dumped = json_dumps(at, JSON_ENCODE_ANY | JSON_COMPACT | JSON_REAL_PRECISION(6));
    snprintf(text, sizeof text, "%s", dumped ? dumped : "nothing");
    free(dumped);
    json_decref(root);
    return text;
}

static void values_are_set_by_their_names_in_the_json(void **unused) {
    (void)unused;
    static const char *const lines[][3] = {
        { "lights/1/radius 0.3", "lights/1/radius", "0.3" },
        { "lights/0/position 1, 2.5, -3", "lights/0/position", "[1.0,2.5,-3.0]" },
        { "lights/0/kind spot", "lights/0/kind", "\"spot\"" },
        { "looks/0/bands 20", "looks/0/bands", "20" },
        { "looks/1/method coefficients", "looks/1/method", "\"coefficients\"" },
        { "looks/0/window lanczos", "looks/0/window", "\"lanczos\"" },
        { "exposure 2.5", "exposure", "2.5" },
        { "tone filmic", "tone", "\"filmic\"" },
        { "shadows true", "shadows", "true" },
        { "bounces 3", "bounces", "3" },
        { "ground on", "ground", "\"on\"" },
        { "background 0.1, 0.2, 0.3", "background", "[0.1,0.2,0.3]" },
        { "environment/name studio", "environment/name", "\"studio\"" },
        { "environment/rotation 90", "environment/rotation", "90.0" },
        { "camera/fov 0.5", "camera/fov", "0.5" },
        { "camera/eye 1, 2, 3", "camera/eye", "[1.0,2.0,3.0]" },
        { "split divided", "split", "\"divided\"" },
        { "divider 0.25", "divider", "0.25" },
        { "samples 7", "samples", "7" },
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        set(lines[i][0]);
        if (strcmp(member(lines[i][1]), lines[i][2]) != 0)
            fail_msg("%s: it is %s, with \"%s\"", lines[i][0], member(lines[i][1]),
                     v.state.message);
    }
    char line[SCENE_NAME_SIZE + 32];
    snprintf(line, sizeof line, "materials/%s ggx:0.3", world.materials[0].name);
    set(line);
    assert_string_equal(view_material_of(&v.state.now, world.materials[0].name), "ggx:0.3");
    set("view/selected 1");
    set("view/path bounce");
    set("view/seconds 2.5");
    set("view/playing true");
    assert_int_equal(v.state.selected, 1);
    assert_string_equal(v.state.paths.names[v.state.paths.at], "bounce");
    assert_true(v.state.playing);
    CHECK_NEAR(2.5, v.state.seconds, 0);
}

/* A method of fewer bands takes as many as it has. */
static void a_method_holds_the_bands(void **unused) {
    (void)unused;
    char line[64];
    for (int from = 0; from < METHODS; from++)
        for (int to = 0; to < METHODS; to++) {
            snprintf(line, sizeof line, "looks/0/method %s", method_table[from].name);
            set(line);
            v.state.now.shading[0].bands = method_table[from].bands_max[DEVICE_AUTO];
            snprintf(line, sizeof line, "looks/0/method %s", method_table[to].name);
            set(line);
            assert_int_equal(v.state.now.shading[0].method, to);
            assert_true(v.state.now.shading[0].bands <= method_table[to].bands_max[DEVICE_AUTO]);
        }
}

static void what_cannot_be_set_changes_nothing(void **unused) {
    (void)unused;
    static const char *const lines[] = {
        "lights/2/radius 1",
        "lights/0/radius 0",
        "lights/0/radius x",
        "lights/0/none 1",
        "lights/radius 1",
        "lights/-1/radius 1",
        "looks/2/bands 3",
        "looks/0/bands 0",
        "looks/0/bands 1e9",
        "looks/0 1",
        "exposure -1",
        "exposure",
        "exposure 1, 2, 3",
        "tone none",
        "scene other.gltf",
        "width 64",
        "origin 1, 2, 3",
        "camera/fov 9",
        "camera/none 1",
        "split both",
        "materials/none ggx",
        "environment/strength -1",
        "view/selected 2",
        "view/selected x",
        "view/seconds -1",
        "view/path none",
        "view/camera 99",
        "view/help true",
        "shadows perhaps",
        "materials",
        "lights",
        "",
        "environment/none 1",
        "background 1",
        "divider nan",
        "view/playing 1",
    };
    static outcome before, after;
    note(&before);
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        set(lines[i]);
        if (!v.state.message[0])
            fail_msg("%s is taken", lines[i]);
        note(&after);
        memset(after.message, 0, sizeof after.message);
        if (memcmp(&before, &after, sizeof before) != 0)
            fail_msg("%s changes something", lines[i]);
    }
}

static float radius(void) {
    return v.state.now.lights[0].emitter.radius;
}

/* Presses on a field and moves by that many pixels. */
static void drag(const char *name, int pixels) {
    double x, y;
    assert_true(ui_find(name, &x, &y));
    take((view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    for (int i = 1; i <= 10; i++) {
        take((view_event) { .kind = VIEW_MOVE, .x = x + 0.1 * i * pixels, .y = y });
        view_lay_out(&v, NULL, false);
    }
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
}

static void a_drag_of_a_field_is_undone_at_once(void **unused) {
    (void)unused;
    const float before = radius();
    const int moments = v.state.history.count;
    drag("radius", 60);
    assert_true(radius() > before);
    assert_int_equal(v.state.history.count, moments + 1);
    by_key(view_find_action("Undo"));
    CHECK_NEAR(before, radius(), 0);
    v.clock += 1; /* not a double click */
    view_lay_out(&v, NULL, false);
    drag("radius", -60);
    assert_true(radius() < before && radius() > 0);
}

/* A double click makes a field for text of it; meanwhile no key is the image's. */
static void numbers_are_typed_into_a_field(void **unused) {
    (void)unused;
    double x, y;
    const method_kind method = v.state.now.shading[0].method;
    const int moments = v.state.history.count;
    click_on("radius");
    click_on("radius");
    assert_true(ui_takes_text());
    take((view_event) { .kind = VIEW_TYPE, .text = "0.751234512m" }); /* letters are no digits */
    take((view_event) { .kind = VIEW_KEY, .text = "m" });
    take((view_event) { .kind = VIEW_HOLD, .letter = 'w' });
    take((view_event) { .kind = VIEW_KEY, .text = "Backspace" });
    take((view_event) { .kind = VIEW_KEY, .text = "Backspace" });
    take((view_event) { .kind = VIEW_KEY, .text = "Enter" });
    assert_false(ui_takes_text());
    CHECK_NEAR(0.7512345f, radius(), 0);
    assert_int_equal(v.state.history.count, moments + 1);
    assert_int_equal(v.state.panel.kind, VIEW_PANEL_CLOSED);
    assert_false(v.state.held[0]);
    assert_int_equal(v.state.now.shading[0].method, method);
    by_key(view_find_action("Next method")); /* keys are the image's again */
    assert_int_not_equal(v.state.now.shading[0].method, method);
    click_on("Materials");
    click_on("find");
    assert_true(ui_takes_text() && ui_find("find", &x, &y));
    take((view_event) { .kind = VIEW_TYPE, .text = "no such material" });
    take((view_event) { .kind = VIEW_MOVE, .x = 200, .y = 200 });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT }); /* leaves the field */
    take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
    view_lay_out(&v, NULL, false);
    assert_false(ui_takes_text());
}

/* The factors of glTF begin as the scene has them; a change of one keeps the others. */
static void factors_of_a_material_are_dragged(void **unused) {
    (void)unused;
    const char *name = world.materials[0].name;
    float base[3], roughness, metallic;
    click_on("Materials");
    drag("roughness", -30);
    const char *given = view_material_of(&v.state.now, name);
    assert_non_null(given);
    assert_int_equal(
        sscanf(given, "gltf:%f,%f,%f:%f:%f", &base[0], &base[1], &base[2], &roughness, &metallic),
        5);
    for (int k = 0; k < 3; k++)
        CHECK_NEAR(world.materials[0].base_color[k], base[k], 1e-4);
    CHECK_NEAR(world.materials[0].metallic, metallic, 0);
    assert_true(roughness < world.materials[0].roughness);
    char line[SCENE_NAME_SIZE + 64];
    snprintf(line, sizeof line, "materials/%s gltf:0.25:0.5:0.5", name);
    set(line);
    v.clock += 1; /* not a double click */
    view_lay_out(&v, NULL, false);
    drag("metallic", 1000);
    assert_string_equal(view_material_of(&v.state.now, name), "gltf:0.25,0.25,0.25:0.5:1");
}

/* Far from 0 a position is typed, with more digits than a float has. */
static void positions_far_from_0_keep_their_digits(void **unused) {
    (void)unused;
    double x, y;
    v.state.now.origin[0] = 8e6;
    assert_true(ui_find("position", &x, &y));
    click(x - 60, y); /* left of the name */
    assert_true(ui_takes_text());
    take((view_event) { .kind = VIEW_KEY, .text = "Ctrl+A" });
    take((view_event) { .kind = VIEW_TYPE, .text = "8000000.125, 2, 3" });
    take((view_event) { .kind = VIEW_KEY, .text = "Enter" });
    CHECK_NEAR(0.125, v.state.now.lights[0].emitter.position.x, 0);
    CHECK_NEAR(2, v.state.now.lights[0].emitter.position.y, 0);
    assert_string_equal(v.state.message, "");
}

/* However dark the picked color is, the brightest channel stays, while the pointer moves on, too.
 */
static void a_picked_color_is_as_bright_as_before(void **unused) {
    (void)unused;
    double x, y;
    const lmp_light *light = &v.state.now.lights[0].emitter;
    const lmp_rgb before = light->radiance;
    click_on("##tint of radiance");
    assert_true(ui_find("##tint of radiance", &x, &y));
    for (int row = 0; row < 12; row++) { /* somewhere below are the wheel and the triangle */
        take((view_event) { .kind = VIEW_MOVE, .x = x + 70, .y = y + 40 + 12 * row });
        take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
        for (int i = 1; i <= 10; i++) {
            take((view_event) { .kind = VIEW_MOVE, .x = x + 70 + 3 * i, .y = y + 40 + 12 * row });
            view_lay_out(&v, NULL, false);
        }
        take((view_event) { .kind = VIEW_RELEASE, .button = VIEW_LEFT });
        v.clock += 1;
    }
    assert_true(memcmp(&before, &light->radiance, sizeof before) != 0);
    CHECK_NEAR(before.r, fmaxf(light->radiance.r, fmaxf(light->radiance.g, light->radiance.b)), 0);
}

/* Every member that a light's file has is a field, of every kind of light. */
static void every_member_of_a_light_is_a_field(void **unused) {
    (void)unused;
    char line[64];
    double x, y;
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++) {
        snprintf(line, sizeof line, "lights/0/kind %s", scene_light_kinds[kind].name);
        set(line);
        view_lay_out(&v, NULL, false);
        for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++)
            if (m->type != SCENE_LIGHT_CORNERS && !ui_find(m->name, &x, &y))
                fail_msg("%s: no field for %s", scene_light_kinds[kind].name, m->name);
    }
}

static void muted_lights_are_kept_but_shine_no_more(void **unused) {
    (void)unused;
    static view_settings shown;
    const lmp_rgb before = v.state.now.lights[0].emitter.radiance;
    v.state.seconds = 0;
    by_key(view_find_action("Mute"));
    view_shown(&v.state, &shown);
    CHECK_NEAR(0, shown.lights[0].emitter.radiance.r, 0);
    assert_true(shown.lights[0].hidden && shown.lights[1].emitter.radiance.r > 0);
    assert_memory_equal(&before, &v.state.now.lights[0].emitter.radiance, sizeof before);
    by_key(view_find_action("Solo"));
    view_shown(&v.state, &shown);
    CHECK_NEAR(0, shown.lights[1].emitter.radiance.r, 0);
    assert_memory_equal(&shown.lights[0], &v.state.now.lights[0], sizeof *shown.lights);
    by_key(view_find_action("Solo"));
    by_key(view_find_action("Copy light")); /* is not muted, though its model is */
    view_shown(&v.state, &shown);
    assert_true(shown.light_count == 3 && shown.lights[2].emitter.radiance.r > 0);
    v.state.selected = 0;
    by_key(view_find_action("Delete light")); /* the others move, and so do their marks */
    view_shown(&v.state, &shown);
    assert_true(shown.lights[0].emitter.radiance.r > 0 && shown.lights[1].emitter.radiance.r > 0);
}

/* Of many lights those that are seen are described, and the list is as long as all of them. */
static void the_last_of_many_lights_is_selected_in_the_list(void **unused) {
    (void)unused;
    static scene_light many[SCENE_LIGHTS_MAX];
    char item[64];
    double x, y;
    for (size_t i = 0; i < SCENE_LIGHTS_MAX; i++)
        many[i].emitter = (lmp_light) { .radius = 1, .radiance = { 1, 1, 1 } };
    view_put_lights(&v.state, many, SCENE_LIGHTS_MAX);
    view_lay_out(&v, NULL, false);
    assert_true(ui_find("0 sphere##light", &x, &y) && !ui_find("20 sphere##light", &x, &y));
    take((view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
    take((view_event) { .kind = VIEW_SCROLL, .y = -1e6 });
    view_lay_out(&v, NULL, false);
    snprintf(item, sizeof item, "%d sphere##light", SCENE_LIGHTS_MAX - 1);
    click_on(item);
    assert_int_equal(v.state.selected, SCENE_LIGHTS_MAX - 1);
    v.state.selected = 1000; /* as by a click on the light itself */
    view_lay_out(&v, NULL, false);
    view_lay_out(&v, NULL, false);
    assert_true(ui_find("1000 sphere##light", &x, &y));
}

/* --- whose event it is ------------------------------------------------------------------------ */

static void what_happens_over_the_sidebar_does_not_reach_the_image(void **unused) {
    (void)unused;
    const scene_camera before = v.state.now.camera;
    take((view_event) { .kind = VIEW_MOVE, .x = WIDTH - 20, .y = HEIGHT - 20 });
    take((view_event) { .kind = VIEW_PRESS, .button = VIEW_LEFT });
    take((view_event) { .kind = VIEW_MOVE, .x = 300, .y = 300 }); /* begun there, it stays there */
    take((view_event) { .kind = VIEW_SCROLL, .y = 3 });
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

/* The handle under the pointer stands out, unless the sidebar is over it, and all can go. */
static void handles_are_drawn_while_they_are_on(void **unused) {
    (void)unused;
    view_marks marks;
    take((view_event) { .kind = VIEW_MOVE, .x = 100, .y = 100 });
    view_lay_out(&v, NULL, false);
    const uint64_t drawn = v.laid;
    view_find_marks(&v.state, &marks);
    int i = 0;
    while (marks.of[i].handle != VIEW_HANDLE_X)
        i++;
    take((view_event) {
        .kind = VIEW_MOVE, .x = (double)marks.of[i].at[1][0], .y = (double)marks.of[i].at[1][1] });
    view_lay_out(&v, NULL, false);
    const uint64_t stands_out = v.laid;
    assert_true(stands_out != drawn);
    take((view_event) { .kind = VIEW_MOVE, .x = 100, .y = 100 });
    by_key(view_find_action("Handles"));
    view_lay_out(&v, NULL, false);
    assert_true(v.laid != drawn && v.laid != stands_out);
    by_key(view_find_action("Handles"));
    view_lay_out(&v, NULL, false);
    assert_true(v.laid == drawn);
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

/* The help hides what opened it, and goes by a click. */
static void a_click_closes_the_help(void **unused) {
    (void)unused;
    double x, y;
    click_on("Window");
    click_on("Help");
    assert_true(v.state.help && !ui_find("Help", &x, &y));
    click(WIDTH - 50, 100);
    assert_true(!v.state.help && v.state.selected == 0 && ui_find("Help", &x, &y));
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

/* While the first scene is read there is nothing but how far that is, and a button against it. */
static void the_first_scene_is_cancelled(void **unused) {
    (void)unused;
    double x, y;
    const scene *world_of = v.state.world;
    v.state.world = NULL;
    v.announcement = "Loading the scene …";
    for (int way = 0; way < 2; way++) {
        view_lay_out(&v, NULL, false);
        const uint64_t before = v.laid;
        v.percent = 40 + way;
        view_lay_out(&v, NULL, false);
        assert_true(v.laid != before && !ui_find("Camera", &x, &y));
        take((view_event) { .kind = VIEW_KEY, .text = "m" });
        assert_false(v.state.requests.quit);
        if (way)
            take((view_event) { .kind = VIEW_KEY, .text = "Escape" });
        else
            click_on("Cancel");
        assert_true(v.state.requests.quit);
        v.state.requests.quit = false;
    }
    v.state.world = world_of;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(every_action_is_the_same_by_button_key_and_script),
        TEST(every_action_has_one_name),
        TEST(values_are_set_by_their_names_in_the_json),
        TEST(a_method_holds_the_bands),
        TEST(what_cannot_be_set_changes_nothing),
        TEST(a_drag_of_a_field_is_undone_at_once),
        TEST(numbers_are_typed_into_a_field),
        TEST(factors_of_a_material_are_dragged),
        TEST(positions_far_from_0_keep_their_digits),
        TEST(a_picked_color_is_as_bright_as_before),
        TEST(every_member_of_a_light_is_a_field),
        TEST(muted_lights_are_kept_but_shine_no_more),
        TEST(the_last_of_many_lights_is_selected_in_the_list),
        TEST(what_happens_over_the_sidebar_does_not_reach_the_image),
        TEST(handles_are_drawn_while_they_are_on),
        TEST(a_drag_of_the_image_stays_the_image_s),
        TEST(the_first_scene_is_cancelled),
        TEST(a_click_closes_the_help),
        TEST(the_title_folds_the_sidebar),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
