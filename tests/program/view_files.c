/* SPDX-License-Identifier: MIT */
/* The viewer's files, its keys as a table, its previews and drawings. */
#include "app/scene/instance.h"
#include "app/view/overlay.h"
#include "app/view/preview.h"
#include "app/view/script.h"
#include "app/view/ui.h"
#include "tests/program/view.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

/* --- settings, screenshots, scripts ----------------------------------------------------------- */

static void screenshots_keep_every_setting(void **unused) {
    (void)unused;
    static view_settings read;
    static unsigned char rgb8[3 * 64 * 48];
    const char *path = "/tmp/lampion-view-test.png";
    base_error error;
    at(320, 240);
    key("v");
    key("t");
    key("Tab");
    key("h");
    state.now.width = 64;
    state.now.height = 48;
    state.now.up = SCENE_UP_Z;
    state.now.camera.height = 0.1f;
    if (!view_write_shot(&state.now, rgb8, path, &error) ||
        !view_read_shot(path, &(view_shot_options) { .pixels_max = 64 * 48 }, &read, &error))
        fail_msg("%s", error.text);
    unlink(path);
    read.camera.aspect = state.now.camera.aspect; /* without effect */
    memcpy(read.camera.name, state.now.camera.name, sizeof read.camera.name);
    assert_memory_equal(&read, &state.now, sizeof read);
}

/* Returns the settings as a screenshot holds them, read as plain JSON. */
static json_t *written_settings(void) {
    json_t *written = view_settings_to_json(&state.now);
    char *text = json_dumps(written, JSON_COMPACT);
    json_t *root = json_loads(text, JSON_DECODE_INT_AS_REAL, NULL);
    free(text);
    json_decref(written);
    return root;
}

static void damaged_settings_are_refused(void **unused) {
    (void)unused;
    static view_settings read;
    base_error error;
    json_t *root = written_settings();
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    static const char *const numbers[] = { "width", "height", "samples", "exposure", "divider" };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        const double before = json_number_value(json_object_get(root, numbers[i]));
        json_object_set_new(root, numbers[i], json_real(-1));
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, numbers[i]));
        json_object_set_new(root, numbers[i], json_null());
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        json_object_set_new(root, numbers[i], json_real(before));
    }
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    json_object_del(root, "shadows");
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    json_object_set_new(root, "shadows", json_integer(1));
    assert_false(view_settings_from_json(root, "shot", &read, &error));
    assert_non_null(strstr(error.text, "shadows"));
    json_object_del(root, "shadows");
    json_object_set_new(root, "bounces", json_integer(1));
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    assert_int_equal(read.bounces, 1);
    json_object_set_new(root, "bounces", json_integer(-1));
    assert_false(view_settings_from_json(root, "shot", &read, &error));
    assert_non_null(strstr(error.text, "bounces"));
    json_object_del(root, "bounces");
    static const char *const parts[] = { "scene", "camera", "looks", "lights", "materials" };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        json_t *item = json_incref(json_object_get(root, parts[i]));
        json_object_del(root, parts[i]);
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, parts[i]));
        json_object_set_new(root, parts[i], item);
    }
    json_object_set_new(root, "scene", json_string("-"));
    assert_false(view_settings_from_json(root, "shot", &read, &error));
    assert_non_null(strstr(error.text, "scene"));
    json_object_set_new(root, "scene", json_string("builtin:balls"));
    static const char *const inputs[] = { "ball=-", "ball=sgd:-:nickel" };
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++) {
        json_object_set_new(root, "materials", json_pack("[s]", inputs[i]));
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, "materials"));
    }
    json_decref(root);
}

/* The settings have one number of the camera or of a light beyond what every other source allows.
 */
static void settings_out_of_reach_are_refused(void **unused) {
    (void)unused;
    static view_settings read;
    static const struct {
        const char *part, *member;
    } cases[] = { { "camera", "eye" },
                  { "camera", "target" },
                  { "lights", "position" },
                  { "lights", "radius" } };
    at(320, 240);
    key("n"); /* a light */
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        base_error error;
        json_t *root = written_settings(), *part = json_object_get(root, cases[i].part);
        assert_true(view_settings_from_json(root, "shot", &read, &error));
        json_t *from = json_is_array(part) ? json_array_get(part, 0) : part;
        json_t *item = json_object_get(from, cases[i].member);
        assert_non_null(item);
        json_t *number = json_is_array(item) ? json_array_get(item, 1) : item;
        json_real_set(number, 1e30);
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, cases[i].part));
        json_decref(root);
    }
}

static bool read_script(const char *text, view_script *script) {
    char path[] = "/tmp/lampion-script-XXXXXX";
    base_error error;
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, text, strlen(text)), strlen(text));
    close(descriptor);
    const bool ok = view_script_read(path, script, &error);
    unlink(path);
    return ok;
}

static void scripts_are_read_strictly(void **unused) {
    (void)unused;
    view_script script;
    assert_true(
        read_script("# a demonstration\n0 move 10 20.5\n0.5 press left shift\n\n"
                    "1 release left # let go\n1 key ?\n2 hold w\n2 free w\n3 scroll -2\n"
                    "4 drop a file.binary  # gold\n4 type 1, 2\n5 size 320 200\n6 shot out.png\n"
                    "6 press \"Add light\"\n7 key Ctrl+Q\n8 hold ctrl",
                    &script));
    assert_int_equal(script.count, 14);
    assert_int_equal(script.lines[11].event.kind, VIEW_ACT);
    assert_string_equal(script.lines[11].event.text, "Add light");
    CHECK_NEAR(20.5, script.lines[0].event.y, 0);
    assert_true(script.lines[1].event.shift);
    assert_string_equal(script.lines[3].event.text, "?");
    assert_string_equal(script.lines[7].event.text, "a file.binary");
    assert_int_equal(script.lines[8].event.kind, VIEW_TYPE);
    assert_string_equal(script.lines[8].event.text, "1, 2");
    assert_int_equal(script.lines[10].kind, VIEW_SCRIPT_SHOT);
    assert_int_equal(script.lines[13].event.letter, 'c');
    view_script_free(&script);
    static const char *const bad[] = { "x",
                                       "1",
                                       "1 move 2",
                                       "1 move 2 3 4",
                                       "nan key m",
                                       "1 key nothing",
                                       "1 jump",
                                       "1 press thumb",
                                       "1 press \"Add light",
                                       "1 press \"Add lights\"",
                                       "1 press \"\"",
                                       "1 hold z",
                                       "1 hold c",
                                       "2 key m\n1 key m",
                                       "1 size 0 5",
                                       "-1 key m",
                                       "1e300 key m",
                                       "1 scroll 1e300",
                                       "1 shot out.jpg",
                                       "1 move 0 -1e300" };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        if (read_script(bad[i], &script))
            fail_msg("taken: %s", bad[i]);
}

static void every_key_of_the_help_does_something(void **unused) {
    (void)unused;
    for (const view_key *row = view_keys; row->key || row->shown; row++) {
        assert_true(!row->key || row->act);
        for (const view_key *other = view_keys; other < row; other++)
            if (row->key && other->key && strcmp(row->key, other->key) == 0)
                fail_msg("%s does two things", row->key);
        if (row->key)
            key(row->key);
    }
    assert_true(state.requests.quit && state.requests.shot && state.requests.reload);
}

/* --- previews and drawings -------------------------------------------------------------------- */

static void previews_have_fewer_triangles_in_the_same_bounds(void **unused) {
    (void)unused;
    scene large, preview;
    base_error error;
    assert_true(scene_load("builtin:atrium", NULL, &large, &error));
    assert_true(view_preview_make(&large, 500, &preview, &error));
    assert_true(preview.index_count > 0 && preview.index_count < large.index_count / 2);
    assert_int_equal(preview.mesh_count, large.mesh_count);
    for (size_t i = 0; i < preview.index_count; i++)
        assert_true(preview.indices[i] < preview.vertex_count);
    for (size_t m = 0; m < preview.mesh_count; m++) {
        const scene_mesh *mesh = &preview.meshes[m];
        assert_true(mesh->first_index + mesh->index_count <= preview.index_count);
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            const float *p = preview.vertices[preview.indices[mesh->first_index + i]].position;
            for (int k = 0; k < 3; k++)
                assert_true(p[k] >= mesh->minimum[k] && p[k] <= mesh->maximum[k]);
        }
    }
    view_preview_free(&preview);
    scene_free(&large);
}

/* The scene has groups of one triangle each, beside many vertices that none of them uses: work
 * proportional to both would exceed the limit of any test. */
static void previews_of_many_meshes_cost_no_more_than_their_triangles(void **unused) {
    (void)unused;
    enum { MESHES = 200000, VERTICES = 16 << 20 };
    scene_vertex *vertices = calloc(VERTICES, sizeof *vertices);
    scene_mesh *meshes = calloc(MESHES, sizeof *meshes);
    uint32_t *indices = malloc(3 * MESHES * sizeof *indices);
    scene_instance *instances = calloc(MESHES, sizeof *instances);
    assert_true(vertices && meshes && indices && instances);
    for (uint32_t i = 0; i < MESHES; i++) {
        meshes[i] = (scene_mesh) { .first_index = 3 * i, .index_count = 3, .maximum = { 1, 1, 0 } };
        instances[i] = scene_instance_identity(i);
        for (uint32_t k = 0; k < 3; k++)
            indices[3 * i + k] = k;
    }
    vertices[1].position[0] = vertices[2].position[1] = 1;
    const scene large = { .vertices = vertices,
                          .indices = indices,
                          .meshes = meshes,
                          .instances = instances,
                          .vertex_count = VERTICES,
                          .index_count = 3 * MESHES,
                          .mesh_count = MESHES,
                          .instance_count = MESHES,
                          .maximum = { 1, 1, 0 } };
    scene preview;
    base_error error;
    assert_true(view_preview_make(&large, 500, &preview, &error));
    assert_int_equal(preview.mesh_count, MESHES);
    assert_int_equal(preview.index_count, 3 * MESHES);
    view_preview_free(&preview);
    free(vertices);
    free(meshes);
    free(instances);
    free(indices);
}

/* Draws every kind once, in frames of their own; returns the box of rows. */
static view_box draw_over(int width, int height, double scale) {
    const view_row rows[] = { { .name = "Lampion" },
                              { .name = "Scene", .value = "a name with ü, 漢字 and \xff" } };
    ui_begin(width, height, scale, 0.1);
    const view_box box = view_draw_rows(rows, 2, width, 10, 1, UI_PAPER);
    CHECK_NEAR(width, box.x + box.width, 1e-3);
    double scroll = -1e3;
    view_box help = view_draw_help(width, height, &scroll);
    assert_true(help.x >= -0.01 && help.x + help.width <= width + 0.01);
    assert_true(help.y >= -0.01 && scroll == 0);
    scroll = 1e6; /* to its end */
    help = view_draw_help(width, height, &scroll);
    assert_true(help.y + help.height <= height + 0.01);
    CHECK_NEAR(fmax(help.height - height, 0), scroll, 1e-3);
    const view_box line =
        view_draw_message("a long message that must be broken", 120 * scale, 60, 400, 0.5);
    assert_true(line.width <= 120 * scale && line.height > 2 * ui_text_height());
    CHECK_NEAR(60, line.x + 0.5 * line.width, 1e-3);
    CHECK_NEAR(400, line.y + line.height, 1e-3);
    ui_end();
    return box;
}

static void drawings_fit_and_grow_with_the_scale(void **unused) {
    (void)unused;
    assert_true(ui_open(false, NULL, NULL));
    draw_over(1280, 720, 1); /* of a font without some of the characters, which the next has */
    const view_box one = draw_over(1280, 720, 1), two = draw_over(1280, 720, 2);
    CHECK_WITHIN(fabs(two.width / one.width - 2), 0.05);
    draw_over(640, 360, 1);
    ui_close();
}

/* What looks the same has the same hash, so that nothing is drawn while nothing changes. */
static void frames_that_look_the_same_have_one_hash(void **unused) {
    (void)unused;
    uint64_t seen[4];
    assert_true(ui_open(false, NULL, NULL));
    for (int i = 0; i < 4; i++) {
        ui_begin(640, 480, 1, 0.1);
        view_draw_message(i == 3 ? "Shadow" : "Shadows", 500, 60, 400, 0.5);
        seen[i] = ui_end();
    }
    assert_true(seen[1] == seen[2] && seen[2] != seen[3]);
    ui_close();
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(screenshots_keep_every_setting),
        TEST(damaged_settings_are_refused),
        TEST(settings_out_of_reach_are_refused),
        TEST(scripts_are_read_strictly),
        TEST(every_key_of_the_help_does_something),
        TEST(previews_have_fewer_triangles_in_the_same_bounds),
        TEST(previews_of_many_meshes_cost_no_more_than_their_triangles),
        TEST(drawings_fit_and_grow_with_the_scale),
        TEST(frames_that_look_the_same_have_one_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
