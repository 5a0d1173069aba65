/* SPDX-License-Identifier: MIT */
/* The viewer without its window: the camera, shading and materials. */
#include "tests/program/view.h"

static double distance(const float *a, const float *b) {
    return sqrt((double)((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                         (a[2] - b[2]) * (a[2] - b[2])));
}

/* --- the camera ------------------------------------------------------------------------------- */

static void orbiting_keeps_the_target_and_the_distance(void **unused) {
    (void)unused;
    const scene_camera before = state.now.camera;
    const double reach = distance(before.eye, before.target);
    at(300, 200);
    button(VIEW_PRESS, VIEW_LEFT, false);
    at(400, 1500); /* far enough to pass the pole, if that were possible */
    button(VIEW_RELEASE, VIEW_LEFT, false);
    at(0, 0); /* but no further */
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

static void check_ray(void) {
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, 123, 45);
    const lmp_vec3 p = { ray.from.x + 7 * ray.direction.x, ray.from.y + 7 * ray.direction.y,
                         ray.from.z + 7 * ray.direction.z };
    double x, y, scale;
    assert_true(view_project(&state.now.camera, 640, 480, p, &x, &y, &scale));
    CHECK_NEAR(123, x, 1e-2);
    CHECK_NEAR(45, y, 1e-2);
}

static void rays_go_where_points_are_projected(void **unused) {
    (void)unused;
    check_ray();
    state.now.camera.height = 3;
    check_ray();
}

/* With parallel rays distant things are as large, and zooming changes the height. */
static void parallel_rays_pan_zoom_and_frame(void **unused) {
    (void)unused;
    scene_camera *camera = &state.now.camera;
    camera->height = 4;
    const scene_camera before = *camera;
    at(100, 100);
    button(VIEW_PRESS, VIEW_MIDDLE, false);
    at(100, 220); /* a quarter of the image */
    button(VIEW_RELEASE, VIEW_MIDDLE, false);
    CHECK_NEAR(1.0, distance(before.eye, camera->eye), 1e-5);
    view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 2 });
    assert_true(camera->height < 4);
    CHECK_NEAR(1.0, distance(before.eye, camera->eye), 1e-5);
    framing_shows_every_corner(unused);
}

/* --- shading, sides, materials ---------------------------------------------------------------- */

static void keys_change_the_side_under_the_pointer(void **unused) {
    (void)unused;
    at(100, 100);
    key("v");
    assert_int_equal(state.now.split, GPU_SPLIT_DIVIDED);
    key("Up");
    assert_int_equal(state.now.shading[0].bands, 11);
    at(500, 100);
    key("Page_Down");
    key("Page_Down");
    key("m");
    key("g");
    assert_int_equal(state.now.shading[0].bands, 11);
    assert_int_equal(state.now.shading[1].bands, 1);
    assert_int_equal(state.now.shading[1].method, METHOD_COEFFICIENTS);
    assert_int_equal(state.now.shading[1].window, LMP_WINDOW_HANNING);
    at(320, 100);
    button(VIEW_PRESS, VIEW_LEFT, false);
    at(200, 100);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    CHECK_NEAR(200.0 / 640, state.now.divider, 1e-5);
    key("y");
    assert_int_equal(state.now.shading[1].bands, 11);
    key("x");
    assert_int_equal(state.now.split, GPU_SPLIT_DIFFERENCE);
    key("x");
    assert_int_equal(state.now.split, GPU_SPLIT_NONE);
    for (int i = 0; i < 300; i++)
        key("Up");
    assert_int_equal(state.now.shading[0].bands,
                     method_table[state.now.shading[0].method].bands_max[DEVICE_AUTO]);
}

static void files_become_materials_where_they_are_dropped(void **unused) {
    (void)unused;
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, 320, 240);
    const view_hit hit = view_pick_surface(&ray, tree);
    assert_true(hit.mesh >= 0);
    const char *name = world.materials[world.meshes[hit.mesh].material].name;
    at(320, 240);
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "none.binary" });
    assert_int_equal(state.now.materials.count, 0);
    assert_non_null(strstr(state.message, "does not exist"));
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "ggx:0.3" });
    assert_string_equal(view_material_of(&state.now, name), "ggx:0.3");
    key("t");
    key("T");
    assert_string_equal(view_material_of(&state.now, name), "ggx:0.3");
    key("t"); /* past the dropped material: the scene's own */
    assert_null(view_material_of(&state.now, name));
    assert_int_equal(state.now.materials.count, 0);
    at(1, 1);
    state.now.camera.target[1] += 1000; /* toward the sky */
    view_handle(&state, &(view_event) { .kind = VIEW_DROP, .text = "ggx:0.3" });
    assert_int_equal(state.now.materials.count, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(orbiting_keeps_the_target_and_the_distance),
        TEST(panning_and_zooming_follow_the_pointer),
        TEST(flying_goes_on_while_keys_are_held),
        TEST(framing_shows_every_corner),
        TEST(rays_go_where_points_are_projected),
        TEST(parallel_rays_pan_zoom_and_frame),
        TEST(keys_change_the_side_under_the_pointer),
        TEST(files_become_materials_where_they_are_dropped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
