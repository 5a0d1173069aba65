/* SPDX-License-Identifier: MIT */
/* The viewer's panel of values, its undo, files that are opened, and what a drag tells. */
#include "app/scene/space.h"
#include "app/scene/vector.h"
#include "app/view/handles.h"
#include "app/view/panel.h"
#include "tests/program/folder.h"
#include "tests/program/view.h"

static void type(const char *text) {
    view_handle(&state, &(view_event) { .kind = VIEW_TYPE, .text = text });
}

static void drop(const char *file) {
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = file });
}

/* Selects a light and opens the panel of its values. */
static void open_light(void) {
    state.now.light_count = 1;
    state.now.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 0.5f, 6 }, .radius = 0.25f, .radiance = { 4, 2, 1 } }
    };
    key("F11"); /* any key makes the light part of the present state */
    key("Tab");
    key("Enter");
    assert_int_equal(state.panel.kind, VIEW_PANEL_LIGHT);
}

/* Returns the value that the panel shows for a name. */
static const char *value_of(const char *name) {
    static view_row rows[VIEW_PANEL_ROWS];
    const int count = view_panel_rows(&state, rows);
    for (int i = 1; i < count; i++)
        if (strcmp(rows[i].name, name) == 0)
            return rows[i].value;
    fail_msg("the panel has no %s", name);
    return NULL;
}

static void choose(const char *name) {
    view_row rows[VIEW_PANEL_ROWS];
    for (int tries = 0; tries < VIEW_PANEL_ROWS; tries++) {
        const int count = view_panel_rows(&state, rows);
        for (int i = 1; i < count; i++)
            if (rows[i].chosen && strcmp(rows[i].name, name) == 0)
                return;
        key("Down");
    }
    fail_msg("%s cannot be chosen", name);
}

static void a_light_has_the_values_that_are_typed(void **unused) {
    (void)unused;
    open_light();
    const lmp_light *light = &state.now.lights[0].emitter;
    choose("position");
    type("1.5, -2, 3");
    key("Enter");
    CHECK_NEAR(1.5, light->position.x, 0);
    CHECK_NEAR(-2, light->position.y, 0);
    assert_string_equal(value_of("position"), "1.5, -2, 3");
    choose("radius");
    type("0.55");
    key("Backspace");
    key("Enter");
    CHECK_NEAR(0.5, light->radius, 0);
    choose("power"); /* per channel; 4 pi^2 r^2 L */
    type("98.696044");
    key("Enter");
    CHECK_NEAR(10, light->radiance.r, 1e-5);
    CHECK_NEAR(10, light->radiance.b, 1e-5);
    assert_true(strncmp(value_of("power"), "98.696", 6) == 0);
}

static void what_is_no_value_changes_nothing(void **unused) {
    (void)unused;
    static const char *const wrong[] = { "-1", "0", "1e40", "1, 2, 3", "2m", "nan", " " };
    open_light();
    choose("radius");
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        state.message[0] = '\0';
        type(wrong[i]);
        key("Enter");
        assert_true(state.message[0] || i == 6); /* a blank alone begins nothing */
        CHECK_NEAR(0.25, state.now.lights[0].emitter.radius, 0);
        if (state.panel.kind == VIEW_PANEL_CLOSED)
            key("Enter");
    }
    type("7");
    key("Escape"); /* what was typed, then the panel */
    assert_false(state.panel.typing);
    assert_int_equal(state.panel.kind, VIEW_PANEL_LIGHT);
    key("Escape");
    assert_int_equal(state.panel.kind, VIEW_PANEL_CLOSED);
    CHECK_NEAR(0.25, state.now.lights[0].emitter.radius, 0);
}

static void letters_are_keys_again_without_the_panel(void **unused) {
    (void)unused;
    open_light();
    const method_kind before = state.now.shading[0].method;
    type("m");
    view_handle(&state, &(view_event) { .kind = VIEW_HOLD, .letter = 'w' });
    const scene_camera camera = state.now.camera;
    view_advance(&state, 1);
    assert_memory_equal(&camera, &state.now.camera, sizeof camera);
    assert_int_equal(state.now.shading[0].method, before);
    key("Escape");
    key("Escape");
    type("m");
    assert_int_not_equal(state.now.shading[0].method, before);
    key("Tab");
    key("Enter");
    key("Delete"); /* its light is removed, and the panel with it */
    type("m");
    assert_int_equal(state.panel.kind, VIEW_PANEL_CLOSED);
}

static void materials_are_typed_by_name(void **unused) {
    (void)unused;
    const char *name = world.materials[0].name;
    key("Enter");
    assert_int_equal(state.panel.kind, VIEW_PANEL_MATERIALS);
    choose(name);
    type("ggx:0.3");
    key("Enter");
    assert_string_equal(view_material_of(&state.now, name), "ggx:0.3");
    assert_string_equal(value_of(name), "ggx:0.3");
    type("ggx:7");
    key("Enter");
    assert_non_null(strstr(state.message, "ggx"));
    assert_string_equal(view_material_of(&state.now, name), "ggx:0.3");
    type("x");
    key("Backspace"); /* nothing typed restores the scene's own value */
    key("Enter");
    assert_null(view_material_of(&state.now, name));
}

static void undo_goes_back_through_lights_and_materials(void **unused) {
    (void)unused;
    const size_t count = state.now.light_count;
    const char *name = world.materials[0].name;
    at(320, 240);
    key("n");
    key("]");
    const float large = state.now.lights[count].emitter.radius;
    key("t");
    assert_non_null(view_material_of(&state.now, name));
    const scene_camera camera = state.now.camera;
    key("c");
    key("Ctrl+Z");
    assert_null(view_material_of(&state.now, name));
    key("Ctrl+Z");
    assert_true(state.now.lights[count].emitter.radius < large);
    key("Ctrl+Z");
    assert_int_equal(state.now.light_count, count);
    assert_true(state.selected < (int)count);
    key("Ctrl+Z");
    assert_non_null(strstr(state.message, "Nothing"));
    key("Ctrl+Y");
    key("Ctrl+Y");
    CHECK_NEAR(large, state.now.lights[count].emitter.radius, 0);
    key("["); /* another change discards what was undone */
    key("Ctrl+Y");
    assert_null(view_material_of(&state.now, name));
    assert_int_equal(state.now.light_count, count + 1);
    assert_true(memcmp(&camera, &state.now.camera, sizeof camera) != 0); /* is nothing to undo */
}

static void a_drag_is_undone_at_once(void **unused) {
    (void)unused;
    double x, y, scale;
    open_light();
    key("Enter");
    const scene_light before = state.now.lights[0];
    view_project(&state.now.camera, 640, 480, before.emitter.position, &x, &y, &scale);
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    for (int i = 1; i <= 20; i++)
        at(x + i, y);
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
    button(VIEW_RELEASE, VIEW_LEFT, false);
    assert_true(memcmp(&before, &state.now.lights[0], sizeof before) != 0);
    key("Ctrl+Z");
    assert_memory_equal(&before, &state.now.lights[0], sizeof before);
}

/* The changes of that many lights are too many to be kept. */
static void the_oldest_steps_are_forgotten(void **unused) {
    (void)unused;
    static scene_light many[SCENE_LIGHTS_MAX];
    for (size_t i = 0; i < SCENE_LIGHTS_MAX; i++)
        many[i].emitter = (lmp_light) { .radius = 1, .radiance = { 1, 1, 1 } };
    view_put_lights(&state, many, SCENE_LIGHTS_MAX);
    for (int i = 0; i < 40; i++)
        key("]");
    assert_true(state.history.bytes <= VIEW_HISTORY_BYTES && state.history.count > 1);
    int undone = 0;
    for (int i = 0; i < 60; i++) {
        state.message[0] = '\0';
        key("Ctrl+Z");
        undone += !state.message[0];
    }
    assert_true(undone > 1 && undone < 40);
}

static void lights_are_saved_and_dropped(void **unused) {
    (void)unused;
    base_error error;
    char *path = strdup(in_folder("saved.json"));
    open_light();
    const scene_light before = state.now.lights[0];
    assert_true(scene_write_lights(path, state.now.origin, state.now.lights, 1, &error));
    key("Enter");
    key("n");
    key("n");
    drop(path);
    assert_int_equal(state.now.light_count, 1);
    assert_memory_equal(&before, &state.now.lights[0], sizeof before);
    key("Ctrl+Z");
    assert_int_equal(state.now.light_count, 3);
    folder_write_text("saved.json", "{ \"lights\": [ { \"radius\": 0 } ] }");
    drop(path);
    assert_non_null(strstr(state.message, "lights[0]"));
    assert_int_equal(state.now.light_count, 3);
    free(path);
}

static void read_lights(scene *s, const char *name) {
    base_error error;
    const scene_lights_options options = { .file = in_folder(name) };
    assert_true(scene_apply_lights(s, &options, &error));
}

/* Lights are read from a screenshot, and from the state that --state writes. */
static void lights_are_read_from_settings(void **unused) {
    (void)unused;
    static const unsigned char black[3 * 640 * 480];
    base_error error;
    open_light();
    assert_true(view_write_shot(&state.now, black, in_folder("shot.png"), &error));
    scene *s = calloc(1, sizeof *s);
    assert_true(s && scene_load("builtin:ball", NULL, s, &error));
    read_lights(s, "shot.png");
    assert_int_equal(s->light_count, 1);
    assert_memory_equal(&s->lights[0], &state.now.lights[0], sizeof *s->lights);
    folder_write_text("state.json", "{ \"scene\": \"x\", \"lights\": [], \"view\": {} }");
    read_lights(s, "state.json");
    assert_int_equal(s->light_count, 0);
    scene_free(s);
    free(s);
}

static void another_scene_starts_afresh(void **unused) {
    (void)unused;
    static scene other;
    base_error error;
    at(320, 240);
    key("n");
    key("t");
    drop("builtin:balls");
    assert_true(state.requests.reload);
    assert_string_equal(state.other, "builtin:balls");
    assert_true(scene_load("builtin:balls", &(scene_options) { .up = SCENE_UP_Z }, &other, &error));
    assert_int_equal(state.now.up, SCENE_UP_Y);
    view_tree *grown = view_tree_begin(&other, &error);
    assert_true(grown && view_state_replace_scene(&state, &other, grown, &error));
    assert_string_equal(state.now.scene, "builtin:balls");
    assert_int_equal(state.now.up, SCENE_UP_Z);
    assert_int_equal(state.now.light_count, other.light_count);
    assert_int_equal(state.now.materials.count, 0);
    assert_true(state.requests.expose && !state.other[0]);
    key("Ctrl+Z");
    assert_non_null(strstr(state.message, "Nothing"));
    key("Ctrl+O");
    type("ggx:0.2");
    at(1, 1);
    state.now.camera.target[1] += 1000; /* toward the sky */
    key("Enter");
    assert_non_null(strstr(state.message, "drop it onto an object"));
    assert_true(view_state_replace_scene(&state, &world, tree, &error));
    view_tree_end(grown);
    scene_free(&other);
}

/* F2 does what --framing inside and outside do. */
static void a_key_sees_a_scene_from_inside_and_from_outside(void **unused) {
    (void)unused;
    const float aspect = (float)state.now.width / (float)state.now.height;
    for (int framing = SCENE_FRAMING_INSIDE; framing >= SCENE_FRAMING_OUTSIDE; framing--) {
        const scene_camera expected = scene_framed_camera(&world, (scene_framing)framing, aspect);
        key("F2");
        assert_memory_equal(&state.now.camera, &expected, sizeof expected);
        assert_int_equal(state.walking, framing == SCENE_FRAMING_INSIDE);
    }
}

/* Outside, the button orbits what stands there; inside, it turns the head. */
static void inside_a_building_the_left_button_looks_around(void **unused) {
    (void)unused;
    assert_false(state.walking);
    key("F2");
    const scene_camera before = state.now.camera;
    at(300, 200);
    button(VIEW_PRESS, VIEW_LEFT, false);
    at(350, 220);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    assert_memory_equal(before.eye, state.now.camera.eye, sizeof before.eye);
    assert_true(memcmp(before.target, state.now.camera.target, sizeof before.target) != 0);
    const scene_camera rotated = state.now.camera;
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
    const lmp_vec3 way = vec_sub(vec_load(state.now.camera.eye), vec_load(rotated.eye));
    const lmp_vec3 view = vec_sub(vec_load(rotated.target), vec_load(rotated.eye));
    assert_true(vec_dot(way, view) > 0.999f * vec_length(way) * vec_length(view));
    scene atrium;
    base_error error;
    assert_true(scene_load("builtin:atrium", NULL, &atrium, &error));
    strcpy(state.other, "builtin:atrium");
    view_tree *grown = view_tree_begin(&atrium, &error);
    assert_true(grown && view_state_replace_scene(&state, &atrium, grown, &error));
    assert_true(state.walking);
    assert_true(view_state_replace_scene(&state, &world, tree, &error));
    view_tree_end(grown);
    scene_free(&atrium);
}

/* --- what a drag tells ------------------------------------------------------------------------ */

static void a_drag_tells_its_number(void **unused) {
    (void)unused;
    static const struct {
        lmp_light_kind kind;
        view_handle_kind handle;
        const char *told;
    } drags[] = {
        { LMP_LIGHT_SPHERE, VIEW_HANDLE_Y, "y +0.5" },
        { LMP_LIGHT_SPHERE, VIEW_HANDLE_YZ, "y +0.5, z -0.25" },
        { LMP_LIGHT_SPHERE, VIEW_HANDLE_SIZE, "radius 0.5" },
        { LMP_LIGHT_TUBE, VIEW_HANDLE_RADIUS, "radius 0.5" },
        { LMP_LIGHT_TUBE, VIEW_HANDLE_WIDTH, "length 1.5" },
        { LMP_LIGHT_RECTANGLE, VIEW_HANDLE_WIDTH, "width 1.5" },
        { LMP_LIGHT_RECTANGLE, VIEW_HANDLE_HEIGHT, "height 0.75" },
        { LMP_LIGHT_POLYGON, VIEW_HANDLE_SIZE, "size × 2" },
        { LMP_LIGHT_SPOT, VIEW_HANDLE_OUTER, "outer 36.0°" },
        { LMP_LIGHT_CAP, VIEW_HANDLE_ANGLE, "angle 18.0°" },
        { LMP_LIGHT_DIRECTIONAL, VIEW_HANDLE_DIRECTION, "elevation 30.0°, azimuth 90.0°" },
    };
    char text[64];
    for (size_t i = 0; i < sizeof drags / sizeof *drags; i++) {
        lmp_light *light = &state.now.lights[0].emitter;
        *light = scene_light_model(drags[i].kind, 1, 8);
        light->position = vec(0, 1, 2);
        state.now.light_count = 1;
        state.selected = 0;
        state.grabbed = state.now.lights[0];
        state.grip.handle = drags[i].handle;
        light->position = vec(0, 1.5f, 1.75f);
        light->radius = 0.5f;
        if (light->kind == LMP_LIGHT_POLYGON) {
            scene_light_resize(light, 2);
        } else {
            light->half[0] = vec(0.75f, 0, 0);
            light->half[1] = vec(0, 0.375f, 0);
        }
        light->outer = 0.2f * PI;
        light->angle = 0.1f * PI;
        light->direction = vec(0, 0.5f, sqrtf(0.75f));
        view_handle_describe(&state, text, sizeof text);
        assert_string_equal(text, drags[i].told);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_light_has_the_values_that_are_typed),
        TEST(what_is_no_value_changes_nothing),
        TEST(letters_are_keys_again_without_the_panel),
        TEST(materials_are_typed_by_name),
        TEST(undo_goes_back_through_lights_and_materials),
        TEST(a_drag_is_undone_at_once),
        TEST(the_oldest_steps_are_forgotten),
        TEST(lights_are_saved_and_dropped),
        TEST(lights_are_read_from_settings),
        TEST(another_scene_starts_afresh),
        TEST(a_key_sees_a_scene_from_inside_and_from_outside),
        TEST(inside_a_building_the_left_button_looks_around),
        TEST(a_drag_tells_its_number),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
