/* SPDX-License-Identifier: MIT */
/* The viewer's lights: picking, dragging, keys. */
#include "app/scene/vector.h"
#include "tests/program/view.h"

static double light_distance(const scene_light *a, const scene_light *b) {
    return (double)vec_length(vec_sub(a->emitter.position, b->emitter.position));
}

/* Puts one light between camera and scene. */
static void put_light(void) {
    state.now.light_count = 1;
    state.now.lights[0] = (scene_light) {
        .emitter = { .position = { 0, 0.5f, 6 }, .radius = 0.25f, .radiance = { 4, 2, 1 } }
    };
}

static void lights_are_dragged_with_the_pointer(void **unused) {
    (void)unused;
    double x, y, scale;
    put_light();
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
    assert_true(scale2 < 0.95 * scale); /* the wheel moved it away */
    button(VIEW_RELEASE, VIEW_LEFT, false);
    at(5, 5);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

/* However far the wheel moves a light or the eye, a file written then can be read again. */
static void nothing_leaves_the_lengths_that_files_take(void **unused) {
    (void)unused;
    double x, y, scale;
    scene_light_error wrong;
    put_light();
    const scene_light *light = &state.now.lights[0];
    view_project(&state.now.camera, 640, 480, light->emitter.position, &x, &y, &scale);
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    for (int step = 0; step < 3000; step++) {
        view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = 1 });
        assert_true(scene_light_check(light, &wrong));
    }
    assert_true(vec_length(light->emitter.position) > 1e-3f * LMP_LENGTH_MAX);
    for (int step = 0; step < 3000; step++)
        view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = -1 });
    assert_true(scene_light_check(light, &wrong));
    button(VIEW_RELEASE, VIEW_LEFT, false);
    for (int step = 0; step < 3000; step++) {
        view_handle(&state, &(view_event) { .kind = VIEW_SCROLL, .y = step % 7 ? -1 : 0.5 });
        assert_true(view_camera_is_valid(&state.now.camera));
    }
}

static void lights_are_dragged_by_parallel_rays(void **unused) {
    (void)unused;
    double x, y, scale;
    scene_camera *camera = &state.now.camera;
    const lmp_vec3 *center = &state.now.lights[0].emitter.position;
    put_light();
    state.handles = false; /* they come before the light */
    camera->height = 8;
    view_project(camera, 640, 480, *center, &x, &y, &scale);
    CHECK_NEAR(60, scale, 1e-3);
    at(x, y + 18); /* the radius is 15 pixels, and the pointer may miss it by 4 */
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, 0);
    const scene_light before = state.now.lights[0];
    at(x, y + 78);
    CHECK_NEAR(1, light_distance(&before, &state.now.lights[0]), 1e-4);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    view_project(camera, 640, 480, *center, &x, &y, &scale);
    at(x, y + 20);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

/* A light in motion is dragged from where it is seen. */
static void moving_lights_are_dragged_too(void **unused) {
    (void)unused;
    static view_settings shown;
    double x, y, scale;
    put_light();
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
    put_light();
    const float *target = state.now.camera.target;
    const lmp_vec3 center = { target[0], target[1], world.minimum[2] - 50 };
    state.now.lights[0].emitter.position = center;
    double x, y, scale;
    view_project(&state.now.camera, 640, 480, center, &x, &y, &scale);
    at(x, y);
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, x, y);
    assert_true(view_pick_surface(&ray, tree).mesh >= 0);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
}

static void lights_change_as_the_keys_say(void **unused) {
    (void)unused;
    put_light();
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
    for (int k = 0; k < 3; k++) /* the circle of hues; clamping may pale it a little */
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
    key("Delete"); /* nothing is selected any longer */
    assert_int_equal(state.now.light_count, 1);
    assert_true(state.message[0]);
    static scene_light many[SCENE_LIGHTS_MAX - 1];
    for (size_t i = 0; i < SCENE_LIGHTS_MAX - 1; i++)
        many[i] = state.now.lights[0];
    view_put_lights(&state, many, SCENE_LIGHTS_MAX - 1);
    key("n");
    key("n");
    assert_int_equal(state.now.light_count, SCENE_LIGHTS_MAX);
}

/* Each key K, through all kinds, leaves a light that could have come from a file. */
static void lights_take_every_kind(void **unused) {
    (void)unused;
    scene_light_error wrong;
    put_light();
    key("Tab");
    const scene_light *light = &state.now.lights[0];
    for (int i = 1; i <= SCENE_LIGHT_KIND_COUNT; i++) {
        key("k");
        assert_int_equal(light->emitter.kind, i % SCENE_LIGHT_KIND_COUNT);
        for (int step = 0; step < 60; step++)
            key("]");
        key("h");
        key("+");
        if (!scene_light_check(light, &wrong))
            fail_msg("%s%s", scene_light_kinds[light->emitter.kind].name, wrong.text);
    }
    CHECK_NEAR(6, light->emitter.position.z, 0);
    key("K");
    assert_int_equal(light->emitter.kind, SCENE_LIGHT_KIND_COUNT - 1);
}

/* A spot is aimed at the surface under the pointer; a sun stands where the pointer is in the sky.
 */
static void lights_are_directed_at_the_pointer(void **unused) {
    (void)unused;
    put_light();
    key("Tab");
    lmp_light *light = &state.now.lights[0].emitter;
    light->kind = LMP_LIGHT_SPOT;
    at(320, 240);
    key("l");
    const view_ray ray = view_ray_through(&state.now.camera, 640, 480, 320, 240);
    const view_hit hit = view_pick_surface(&ray, tree);
    assert_true(hit.mesh >= 0);
    const lmp_vec3 point = vec_add(ray.from, vec_scale(ray.direction, hit.distance));
    const lmp_vec3 to = vec_normalize(vec_sub(point, light->position), vec(0, 0, 0));
    CHECK_NEAR(0, vec_length(vec_sub(to, light->direction)), 1e-5);
    light->kind = LMP_LIGHT_DIRECTIONAL;
    key("l");
    CHECK_NEAR(0, vec_length(vec_sub(ray.direction, light->direction)), 1e-5);
}

/* A light without a position is never under the pointer. */
static void suns_and_skies_are_not_picked(void **unused) {
    (void)unused;
    double x, y, scale;
    put_light();
    state.now.lights[0].emitter.kind = LMP_LIGHT_CAP;
    view_project(&state.now.camera, 640, 480, state.now.lights[0].emitter.position, &x, &y, &scale);
    at(x, y);
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, -1);
    button(VIEW_RELEASE, VIEW_LEFT, false);
    state.now.lights[0].emitter.kind = LMP_LIGHT_POINT;
    state.now.lights[0].emitter.radius = 0;
    button(VIEW_PRESS, VIEW_LEFT, false);
    assert_int_equal(state.selected, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(lights_are_dragged_with_the_pointer),
        TEST(lights_are_dragged_by_parallel_rays),
        TEST(nothing_leaves_the_lengths_that_files_take),
        TEST(moving_lights_are_dragged_too),
        TEST(lights_behind_a_surface_are_not_picked),
        TEST(lights_change_as_the_keys_say),
        TEST(lights_take_every_kind),
        TEST(lights_are_directed_at_the_pointer),
        TEST(suns_and_skies_are_not_picked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
