/* SPDX-License-Identifier: MIT */
/* Shadows on what lets light through from behind: rays to there start on that side, so the surface
 * does not hide the light from itself, and what stands behind it does. */
#include "tests/gpu/shadow.h"

/* A sheet in z = 0 that reflects and transmits the same, and a black box behind its right half. */
static void make_leaf(scene *world) {
    scene_builder builder = { .out_of_memory = false };
    add_material(&builder, "leaf", 0.8f);
    add_material(&builder, "box", 0);
    scene_material *leaf = builder_items(&builder, BLOB_MATERIALS);
    leaf->transmission = 0.5f;
    for (int c = 0; c < 3; c++)
        leaf->transmission_color[c] = 0.8f;
    leaf->flags = SCENE_DOUBLE_SIDED;
    scene_shaper shaper = { .builder = &builder };
    shape_quad(&shaper, vec(-1, 0, 0), vec(1, 0, 0), vec(1, 1, 0), vec(-1, 1, 0));
    shaper.material = 1;
    shape_box(&shaper, vec(0.3f, -1, -0.4f), vec(3, 3, -0.3f));
    shaper_finish(&shaper);
    open_scene(&builder, world);
}

/* Light arrives in each way, from behind and from the front. */
static void light_arrives(stage *s, int way, float side, environment *sky) {
    const lmp_light lights[] = {
        { .kind = LMP_LIGHT_SPHERE,
          .position = { -0.8f, 0.6f, 3 * side },
          .radius = 0.5f,
          .radiance = { 10, 10, 10 } },
        { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0, 0, side }, .irradiance = { 1, 1, 1 } },
    };
    static float texels[3 * 8 * 4];
    *sky = (environment) { .azimuth = 0 };
    set_lights(s, &lights[way < 2 ? way : 0], way < 2 ? 1 : 0);
    if (way < 2)
        return;
    for (size_t i = 0; i < sizeof texels / sizeof *texels; i++)
        texels[i] = 1;
    sky->light = (image) { 8, 4, texels };
}

/* Finds, at the sheet's left and right ends, what arrives with shadows relative to what arrives
 * without. */
static void find_parts(int way, float side, double parts[2]) {
    static const int columns[2] = { WIDTH / 4, 3 * WIDTH / 4 };
    const shadow_settings settings = { .rays = 400, .raw = true };
    base_error error = { "" };
    environment sky;
    stage s;
    open_scene_stage(&s, make_leaf);
    s.frame.camera = (scene_camera) {
        .eye = { 0, 0.5f, 4 }, .target = { 0, 0.5f, 0 }, .up = { 0, 1, 0 }, .height = 4 / 3.0f
    };
    light_arrives(&s, way, side, &sky);
    if (way == 2)
        expect(environment_project(&sky, BANDS, &error), &error);
    gpu_set_environment(s.renderer, way == 2 ? &sky : NULL);
    image bare = render_image(s.renderer, &s.frame);
    image shadowed = draw_shadows(&s, way == 2 ? &sky : NULL, &settings);
    for (int i = 0; i < 2; i++) {
        const int pixel = 3 * (HEIGHT / 2 * WIDTH + columns[i]);
        assert_true(bare.rgb[pixel] > 0.01f);
        parts[i] = (double)shadowed.rgb[pixel] / (double)bare.rgb[pixel];
    }
    image_free(&bare);
    image_free(&shadowed);
    close_stage(&s);
}

/* A sphere and sunlight from behind arrive at the left end but not behind the box, and from the
 * front at both. */
static void a_leaf_hides_no_light_from_itself_and_a_box_behind_it_does(void **state) {
    (void)state;
    for (int way = 0; way < 2; way++)
        for (int k = 0; k < 2; k++) {
            double parts[2];
            find_parts(way, k ? 1 : -1, parts);
            CHECK_WITHIN(fabs(parts[0] - 1), 1e-3);
            CHECK_WITHIN(fabs(parts[1] - k), 1e-3);
        }
}

/* Returns the fraction of a sky's irradiance through a rectangle that has a corner above the point,
 * of sides a and b relative to that height (Howell's catalog, B-3). */
static double corner_part(double a, double b) {
    const double across = sqrt(1 + a * a), along = sqrt(1 + b * b);
    return (a / across * atan(b / across) + b / along * atan(a / along)) / (2 * (double)PI);
}

/* Returns the fraction that the box hides from a point at x, where its edge at 0.3 lies at depth d:
 * the box reaches from there to 3, and from -1.5 to 2.5 above the point. */
static double hidden_part(double x, double d) {
    const double left = (0.3 - x) / d, right = (3 - x) / d, low = 1.5 / d, high = 2.5 / d;
    return corner_part(right, low) + corner_part(right, high) -
           (left > 0 ? 1 : -1) * (corner_part(fabs(left), low) + corner_part(fabs(left), high));
}

/* Half of an even sky is seen from the front, where nothing hides it, and half from behind. */
static void of_an_even_sky_a_box_behind_a_leaf_hides_its_part_of_half(void **state) {
    (void)state;
    double parts[2];
    find_parts(2, 1, parts);
    CHECK_WITHIN(fabs(parts[0] - (1 - 0.5 * hidden_part(-0.5, 0.4))), 0.02);
    CHECK_WITHIN(fabs(parts[1] - (1 - 0.5 * hidden_part(0.5, 0.3))), 0.02);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_leaf_hides_no_light_from_itself_and_a_box_behind_it_does),
        cmocka_unit_test(of_an_even_sky_a_box_behind_a_leaf_hides_its_part_of_half),
    };
    return cmocka_run_group_tests(tests, open_device, close_device);
}
