/* SPDX-License-Identifier: MIT */
/* The viewer without its window: cameras, picking, dragging, keys, settings, scripts. */
#include "app/scene/vector.h"
#include "app/view/draft.h"
#include "app/view/overlay.h"
#include "app/view/script.h"
#include "app/view/state.h"

#include "tests/oracle/check.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define CHECK_NEAR(expected, actual, bound)                                                        \
    CHECK_WITHIN(fabs((double)(actual) - (double)(expected)), bound)

static scene world;
static view_state state;

static int open_state(void **unused) {
    (void)unused;
    cli_error error;
    static view_settings settings;
    memset(&settings, 0, sizeof settings);
    if (!scene_load("builtin:ball", NULL, &world, &error))
        return -1;
    strcpy(settings.scene, "builtin:ball");
    settings.width = 640;
    settings.height = 480;
    settings.samples = 4;
    settings.exposure = 1;
    settings.divider = 0.5f;
    settings.looks[0] = settings.looks[1] = (view_look) { GPU_METHOD_ZONAL, 10, LMP_WINDOW_NONE };
    settings.camera = (scene_camera) { .eye = { 0, 0, 10 }, .up = { 0, 1, 0 }, .fov = 1 };
    if (!view_state_open(&world, &settings, NULL, &state, &error))
        return -1;
    for (int k = 0; k < 3; k++)
        state.now.camera.target[k] = 0.5f * (world.minimum[k] + world.maximum[k]);
    return 0;
}

static int close_state(void **unused) {
    (void)unused;
    view_state_close(&state);
    scene_free(&world);
    return 0;
}

static void key(const char *name) {
    view_handle(&state, &(view_event) { .kind = VIEW_KEY, .text = name });
}

static void at(double x, double y) {
    view_handle(&state, &(view_event) { .kind = VIEW_MOVE, .x = x, .y = y });
}

static void button(view_event_kind kind, view_button which, bool shift) {
    view_handle(&state, &(view_event) { .kind = kind, .button = which, .shift = shift });
}

static double distance(const float *a, const float *b) {
    return sqrt((double)((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                         (a[2] - b[2]) * (a[2] - b[2])));
}

/* --- the camera ---------------------------------------------------------------------------------
 */

static void orbiting_keeps_the_target_and_the_distance(void **unused) {
    (void)unused;
    const scene_camera before = state.now.camera;
    const double reach = distance(before.eye, before.target);
    at(300, 200);
    button(VIEW_PRESS, VIEW_LEFT, false);
    at(400, 1500); /* far enough to go over the pole, if that were let */
    button(VIEW_RELEASE, VIEW_LEFT, false);
    at(0, 0); /* and no further */
    const scene_camera *after = &state.now.camera;
    assert_memory_equal(before.target, after->target, sizeof before.target);
    CHECK_NEAR(reach, distance(after->eye, after->target), 1e-3);
    assert_true(after->eye[1] > before.eye[1] + 0.5f * (float)reach);
    assert_true(distance(before.eye, after->eye) > 1);
    CHECK_NEAR(1.0, after->up[1], 0.0);
}

static void panning_and_zooming_follow_the_pointer(void **unused) {
    (void)unused;
    scene_camera *camera = &state.now.camera;
    double x, y, scale, x2, y2;
    const lmp_vec3 target = { camera->target[0], camera->target[1], camera->target[2] };
    assert_true(view_project(camera, 640, 480, target, &x, &y, &scale));
    CHECK_NEAR(320, x, 1e-3);
    CHECK_NEAR(240, y, 1e-3);
    at(100, 100);
    button(VIEW_PRESS, VIEW_MIDDLE, false);
    at(150, 130);
    button(VIEW_RELEASE, VIEW_MIDDLE, false);
    assert_true(view_project(camera, 640, 480, target, &x2, &y2, &scale));
    CHECK_NEAR(x + 50, x2, 1e-2);
    CHECK_NEAR(y + 30, y2, 1e-2);
    const double reach = distance(camera->eye, camera->target);
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 2 });
    assert_true(distance(camera->eye, camera->target) < 0.8 * reach);
    for (int i = 0; i < 1000; i++)
        view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
    assert_true(distance(camera->eye, camera->target) > 0);
}

static void flying_goes_on_while_keys_are_held(void **unused) {
    (void)unused;
    const scene_camera before = state.now.camera;
    view_handle(&state, &(view_event) { .kind = VIEW_HOLD, .letter = 'd' });
    view_advance(&state, 0.25);
    const double slow = distance(before.eye, state.now.camera.eye);
    assert_true(slow > 0);
    CHECK_NEAR(slow, distance(before.target, state.now.camera.target), 1e-4);
    view_handle(&state, &(view_event) { .kind = VIEW_HOLD, .letter = 'd', .shift = true });
    view_advance(&state, 0.25);
    assert_true(distance(before.eye, state.now.camera.eye) > 3 * slow);
    view_handle(&state, &(view_event) { .kind = VIEW_FREE });
    const scene_camera rest = state.now.camera;
    view_advance(&state, 1);
    assert_memory_equal(&rest, &state.now.camera, sizeof rest);
}

static void framing_shows_every_corner(void **unused) {
    (void)unused;
    state.now.camera.eye[0] += 3;
    key("f");
    for (int corner = 0; corner < 8; corner++) {
        const lmp_vec3 p = { corner & 1 ? world.minimum[0] : world.maximum[0],
                             corner & 2 ? world.minimum[1] : world.maximum[1],
                             corner & 4 ? world.minimum[2] : world.maximum[2] };
        double x, y, scale;
        assert_true(view_project(&state.now.camera, 640, 480, p, &x, &y, &scale));
        assert_true(x >= 0 && x <= 640 && y >= 0 && y <= 480);
    }
}

static void rays_go_where_points_are_projected(void **unused) {
    (void)unused;
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, 123, 45);
    const lmp_vec3 p = { ray.from.x + 7 * ray.direction.x, ray.from.y + 7 * ray.direction.y,
                         ray.from.z + 7 * ray.direction.z };
    double x, y, scale;
    assert_true(view_project(&state.now.camera, 640, 480, p, &x, &y, &scale));
    CHECK_NEAR(123, x, 1e-2);
    CHECK_NEAR(45, y, 1e-2);
}

/* --- lights -------------------------------------------------------------------------------------
 */

static double light_distance(const scene_light *a, const scene_light *b) {
    return (double)vec_length(vec_sub(a->emitter.position, b->emitter.position));
}

/* One light between camera and scene. */
static void place_light(void) {
    state.now.light_count = 1;
    state.now.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 0.5f, 6 }, .radius = 0.25f, .radiance = { 4, 2, 1 } }
    };
}

static void lights_are_dragged_with_the_pointer(void **unused) {
    (void)unused;
    double x, y, scale;
    place_light();
    const scene_camera *camera = &state.now.camera;
    assert_true(view_project(camera, 640, 480, (lmp_vec3) { 0, 0.5f, 6 }, &x, &y, &scale));
    at(x + 3, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, 0);
    at(x + 63, y - 20);
    const lmp_vec3 *center = &state.now.lights[0].emitter.position;
    double x2, y2, scale2;
    view_project(camera, 640, 480, *center, &x2, &y2, &scale2);
    CHECK_NEAR(x + 60, x2, 1e-2);
    CHECK_NEAR(y - 20, y2, 1e-2);
    CHECK_NEAR(scale, scale2, 1e-2); /* in a plane across the view */
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
    view_project(camera, 640, 480, *center, &x2, &y2, &scale2);
    CHECK_NEAR(x + 60, x2, 1e-2);
    assert_true(scale2 < 0.95 * scale); /* the wheel took it away */
    button(VIEW_RELEASE, VIEW_LEFT, false);
    at(5, 5);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

/* A light that moves is dragged from where it is seen. */
static void moving_lights_are_dragged_too(void **unused) {
    (void)unused;
    static view_settings shown;
    double x, y, scale;
    place_light();
    key("space");
    view_advance(&state, 1.3);
    key("space");
    view_shown(&state, &shown);
    assert_true(light_distance(&shown.lights[0], &state.now.lights[0]) >= 0);
    const lmp_vec3 seen = shown.lights[0].emitter.position;
    view_project(&state.now.camera, 640, 480, seen, &x, &y, &scale);
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, 0);
    const scene_light before = state.now.lights[0];
    at(x, y); /* no movement, no change */
    CHECK_NEAR(0, light_distance(&before, &state.now.lights[0]), 1e-4);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

static void lights_behind_a_surface_are_not_picked(void **unused) {
    (void)unused;
    place_light();
    const float *target = state.now.camera.target;
    const lmp_vec3 center = { target[0], target[1], world.minimum[2] - 50 };
    state.now.lights[0].emitter.position = center;
    double x, y, scale;
    view_project(&state.now.camera, 640, 480, center, &x, &y, &scale);
    at(x, y);
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, x, y);
    assert_true(view_pick_surface(&ray, &world).mesh >= 0);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

static void lights_change_as_the_keys_say(void **unused) {
    (void)unused;
    place_light();
    key("Tab");
    assert_int_equal(state.selected, 0);
    const scene_light before = state.now.lights[0], *light = &state.now.lights[0];
    key("]");
    assert_true(light->emitter.radius > before.emitter.radius);
    CHECK_NEAR(before.emitter.radiance.r * before.emitter.radius * before.emitter.radius,
               light->emitter.radiance.r * light->emitter.radius * light->emitter.radius, 1e-5);
    key("[");
    key("+");
    CHECK_NEAR(1.25 * (double)before.emitter.radiance.g, light->emitter.radiance.g, 1e-4);
    key("-");
    for (int i = 0; i < 12; i++)
        key("h");
    for (int k = 0; k < 3; k++) /* around the circle; clamping to gamut may pale it a little */
        assert_true((&light->emitter.radiance.r)[k] >= 0 &&
                    isfinite((&light->emitter.radiance.r)[k]));
    CHECK_NEAR(4, light->emitter.radiance.r, 0.05);
    const double spread = (double)(light->emitter.radiance.r - light->emitter.radiance.b);
    key("j");
    assert_true((double)(light->emitter.radiance.r - light->emitter.radiance.b) < 0.9 * spread);
    for (int i = 0; i < 400; i++) {
        key("[");
        key("+");
    }
    assert_true(light->emitter.radius > 0 && isfinite(light->emitter.radiance.r));
    at(320, 240);
    key("n");
    assert_int_equal(state.now.light_count, 2);
    assert_int_equal(state.selected, 1);
    key("Delete");
    key("Delete"); /* nothing is selected any more */
    assert_int_equal(state.now.light_count, 1);
    assert_true(state.message[0]);
    while (state.now.light_count < SCENE_LIGHTS_MAX)
        key("n");
    key("n");
    assert_int_equal(state.now.light_count, SCENE_LIGHTS_MAX);
}

/* --- shading, sides, materials ------------------------------------------------------------------
 */

static void keys_change_the_side_under_the_pointer(void **unused) {
    (void)unused;
    at(100, 100);
    key("v");
    assert_int_equal(state.now.split, GPU_SPLIT_DIVIDED);
    key("Up");
    assert_int_equal(state.now.looks[0].bands, 11);
    at(500, 100);
    key("Page_Down");
    key("Page_Down");
    key("m");
    key("g");
    assert_int_equal(state.now.looks[0].bands, 11);
    assert_int_equal(state.now.looks[1].bands, 1);
    assert_int_equal(state.now.looks[1].method, GPU_METHOD_COEFFICIENTS);
    assert_int_equal(state.now.looks[1].window, LMP_WINDOW_HANNING);
    at(320, 100);
    button(VIEW_PRESS, VIEW_LEFT, false);
    at(200, 100);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    CHECK_NEAR(200.0 / 640, state.now.divider, 1e-5);
    key("y");
    assert_int_equal(state.now.looks[1].bands, 11);
    key("x");
    assert_int_equal(state.now.split, GPU_SPLIT_DIFFERENCE);
    key("x");
    assert_int_equal(state.now.split, GPU_SPLIT_NONE);
    for (int i = 0; i < 300; i++)
        key("Up");
    assert_int_equal(state.now.looks[0].bands, view_bands_max(state.now.looks[0].method));
}

static void files_become_materials_where_they_are_dropped(void **unused) {
    (void)unused;
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, 320, 240);
    const view_hit hit = view_pick_surface(&ray, &world);
    assert_true(hit.mesh >= 0);
    const char *slot = world.materials[world.meshes[hit.mesh].material].name;
    at(320, 240);
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "none.binary" });
    assert_int_equal(state.now.material_count, 0);
    assert_non_null(strstr(state.message, "does not exist"));
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "ggx:0.3" });
    assert_string_equal(view_material_of(&state.now, slot), "ggx:0.3");
    key("t");
    key("T");
    assert_string_equal(view_material_of(&state.now, slot), "ggx:0.3");
    key("t"); /* past the dropped one: as the scene has it */
    assert_null(view_material_of(&state.now, slot));
    assert_int_equal(state.now.material_count, 0);
    at(1, 1);
    state.now.camera.target[1] += 1000; /* the sky */
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "ggx:0.3" });
    assert_int_equal(state.now.material_count, 0);
}

/* --- settings, screenshots, scripts -------------------------------------------------------------
 */

static void screenshots_keep_every_setting(void **unused) {
    (void)unused;
    static view_settings read;
    static unsigned char rgb8[3 * 64 * 48];
    const char *path = "/tmp/lampion-view-test.png";
    cli_error error;
    at(320, 240);
    key("v");
    key("t");
    key("Tab");
    key("h");
    state.now.width = 64;
    state.now.height = 48;
    if (!view_write_shot(&state.now, rgb8, path, &error) || !view_read_shot(path, &read, &error))
        fail_msg("%s", error.text);
    unlink(path);
    read.camera.aspect = state.now.camera.aspect; /* of no effect */
    memcpy(read.camera.name, state.now.camera.name, sizeof read.camera.name);
    assert_memory_equal(&read, &state.now, sizeof read);
}

static void damaged_settings_are_refused(void **unused) {
    (void)unused;
    static view_settings read;
    cli_error error;
    cJSON *written = view_settings_to_json(&state.now);
    char *text = cJSON_PrintUnformatted(written);
    cJSON *root = cJSON_Parse(text);
    cJSON_free(text);
    cJSON_Delete(written);
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    static const char *const numbers[] = { "width", "height", "samples", "exposure", "divider" };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++) {
        cJSON *item = cJSON_GetObjectItem(root, numbers[i]);
        const double before = item->valuedouble;
        cJSON_SetNumberValue(item, -1);
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, numbers[i]));
        cJSON_SetNumberValue(item, (double)NAN);
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        cJSON_SetNumberValue(item, before);
    }
    assert_true(view_settings_from_json(root, "shot", &read, &error));
    static const char *const parts[] = { "scene", "camera", "looks", "lights", "materials" };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        cJSON *item = cJSON_DetachItemFromObject(root, parts[i]);
        assert_false(view_settings_from_json(root, "shot", &read, &error));
        assert_non_null(strstr(error.text, parts[i]));
        cJSON_AddItemToObject(root, parts[i], item);
    }
    cJSON_Delete(root);
}

static bool read_script(const char *text, view_script *script) {
    char path[] = "/tmp/lampion-script-XXXXXX";
    cli_error error;
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
                    "4 drop a file.binary  # gold\n5 size 320 200\n6 shot out.png\n7 key Ctrl+Q",
                    &script));
    assert_int_equal(script.count, 11);
    CHECK_NEAR(20.5, script.lines[0].event.y, 0);
    assert_true(script.lines[1].event.shift);
    assert_string_equal(script.lines[3].event.text, "?");
    assert_string_equal(script.lines[7].event.text, "a file.binary");
    assert_int_equal(script.lines[9].kind, VIEW_SCRIPT_SHOT);
    view_script_free(&script);
    static const char *const bad[] = { "x",
                                       "1",
                                       "1 move 2",
                                       "1 move 2 3 4",
                                       "nan key m",
                                       "1 key nothing",
                                       "1 jump",
                                       "1 press thumb",
                                       "1 hold z",
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
    assert_true(state.wishes.quit && state.wishes.shot && state.wishes.reload);
}

/* --- drafts and drawings ------------------------------------------------------------------------
 */

static void drafts_have_fewer_triangles_in_the_same_bounds(void **unused) {
    (void)unused;
    scene large, draft;
    cli_error error;
    assert_true(scene_load("builtin:atrium", NULL, &large, &error));
    assert_true(view_draft_make(&large, 500, &draft, &error));
    assert_true(draft.index_count > 0 && draft.index_count < large.index_count / 2);
    assert_int_equal(draft.mesh_count, large.mesh_count);
    for (size_t i = 0; i < draft.index_count; i++)
        assert_true(draft.indices[i] < draft.vertex_count);
    for (size_t m = 0; m < draft.mesh_count; m++) {
        const scene_mesh *mesh = &draft.meshes[m];
        assert_true(mesh->first_index + mesh->index_count <= draft.index_count);
        for (uint32_t i = 0; i < mesh->index_count; i++) {
            const float *p = draft.vertices[draft.indices[mesh->first_index + i]].position;
            for (int k = 0; k < 3; k++)
                assert_true(p[k] >= mesh->minimum[k] && p[k] <= mesh->maximum[k]);
        }
    }
    view_draft_free(&draft);
    scene_free(&large);
}

static void drawings_fit_and_grow_with_the_scale(void **unused) {
    (void)unused;
    const view_row rows[] = { { "Lampion", "" }, { "Scene", "a name with ü, 漢字 and \xff" } };
    view_drawing one = view_draw_panel(rows, 2, 1), two = view_draw_panel(rows, 2, 2);
    assert_non_null(one.pixels);
    CHECK_WITHIN(fabs(two.width / (double)one.width - 2), 0.2);
    view_drawing_free(&one);
    view_drawing_free(&two);
    view_drawing help = view_draw_help(1280, 720, 1);
    assert_true(help.pixels && help.width <= 1280 && help.height <= 720);
    view_drawing_free(&help);
    help = view_draw_help(640, 360, 1);
    assert_true(help.width <= 640 && help.height <= 360);
    view_drawing_free(&help);
    view_drawing line = view_draw_message("a long message that must be broken", 120, 1);
    assert_true(line.pixels && line.width <= 120);
    view_drawing_free(&line);
}

#define TEST(function) cmocka_unit_test_setup_teardown(function, open_state, close_state)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(orbiting_keeps_the_target_and_the_distance),
        TEST(panning_and_zooming_follow_the_pointer),
        TEST(flying_goes_on_while_keys_are_held),
        TEST(framing_shows_every_corner),
        TEST(rays_go_where_points_are_projected),
        TEST(lights_are_dragged_with_the_pointer),
        TEST(moving_lights_are_dragged_too),
        TEST(lights_behind_a_surface_are_not_picked),
        TEST(lights_change_as_the_keys_say),
        TEST(keys_change_the_side_under_the_pointer),
        TEST(files_become_materials_where_they_are_dropped),
        TEST(screenshots_keep_every_setting),
        TEST(damaged_settings_are_refused),
        TEST(scripts_are_read_strictly),
        TEST(every_key_of_the_help_does_something),
        TEST(drafts_have_fewer_triangles_in_the_same_bounds),
        TEST(drawings_fit_and_grow_with_the_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
