/* SPDX-License-Identifier: MIT */
/* Drawings: app/image/figure.h. */
#include "app/image/figure.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

static const lmp_rgb red = { 1, 0, 0 }, green = { 0, 1, 0 }, white = { 1, 1, 1 };

static const float *pixel(const image *pixels, int x, int y) {
    return pixels->rgb + 3 * (y * pixels->width + x);
}

static float up_and_down(lmp_vec3 direction, const void *user) {
    (void)user;
    return direction.z;
}

static float ball(lmp_vec3 direction, const void *user) {
    (void)direction;
    return *(const float *)user;
}

static void positive_is_above_and_negative_below_in_their_colors(void **state) {
    (void)state;
    image pixels;
    base_error error;
    assert_true(image_create(&pixels, 60, 50, &error));
    figure_fill(&pixels, (figure_box) { 0, 0, 60, 50 }, white);
    const figure_lobe lobe = { up_and_down, NULL, red, green };
    assert_true(figure_draw_lobe(&pixels, (figure_box) { 5, 0, 50, 50 }, &lobe, &error));
    const float *const above = pixel(&pixels, 30, 14), *const below = pixel(&pixels, 30, 36);
    assert_true(above[0] > 2 * above[1] && below[1] > 2 * below[0]);
    assert_true(pixel(&pixels, 8, 25)[0] == 1.0f && pixel(&pixels, 8, 25)[1] == 1.0f);
    image_free(&pixels);
}

static void a_ball_covers_the_area_of_a_disc_without_holes(void **state) {
    (void)state;
    image pixels;
    base_error error;
    const float radius = 0.8f;
    assert_true(image_create(&pixels, 100, 100, &error));
    const figure_lobe lobe = { ball, &radius, white, white };
    assert_true(figure_draw_lobe(&pixels, (figure_box) { 0, 0, 100, 100 }, &lobe, &error));
    int covered = 0;
    for (int i = 0; i < 100 * 100; i++)
        covered += pixels.rgb[3 * i] > 0.0f;
    const double disc = 3.14159265 * 0.8 * 0.8 * 47 * 47;
    /* Pixels on the edge count whole: half a pixel more on every side. */
    CHECK_WITHIN(fabs(covered - disc - 3.14159265 * 0.8 * 47), 0.01 * disc);
    image_free(&pixels);
}

static void what_lies_outside_of_the_image_is_not_drawn(void **state) {
    (void)state;
    image pixels;
    base_error error;
    const float radius = 1.0f;
    const figure_lobe lobe = { ball, &radius, red, red };
    assert_true(image_create(&pixels, 20, 20, &error));
    assert_true(figure_draw_lobe(&pixels, (figure_box) { -10, 10, 20, 20 }, &lobe, &error));
    figure_fill(&pixels, (figure_box) { 15, -5, 50, 10 }, green);
    figure_text(&pixels, (figure_box) { -50, -50, 200, 200 }, 70, green, "l=0123456789+-m");
    assert_true(pixel(&pixels, 0, 13)[0] > 0.0f);
    assert_true(pixel(&pixels, 19, 0)[1] == 1.0f);
    image_free(&pixels);
}

/* Names of materials are written whole. */
static void every_character_of_a_name_has_a_shape_of_its_own(void **state) {
    (void)state;
    static const char known[] = "abcdefghijklmnopqrstuvwxyz0123456789+-=.:,/_";
    enum { COUNT = sizeof known - 1, SIDE = 9 };
    static float shapes[COUNT][3 * SIDE * SIDE];
    for (size_t i = 0; i < COUNT; i++) {
        const char text[2] = { known[i], 0 };
        image pixels = { SIDE, SIDE, shapes[i] };
        figure_text(&pixels, (figure_box) { 0, 0, SIDE, SIDE }, FIGURE_LETTER_HEIGHT, white, text);
        const float blank[3 * SIDE * SIDE] = { 0 };
        assert_memory_not_equal(shapes[i], blank, sizeof blank);
        for (size_t k = 0; k < i; k++)
            assert_memory_not_equal(shapes[i], shapes[k], sizeof blank);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(positive_is_above_and_negative_below_in_their_colors),
        cmocka_unit_test(a_ball_covers_the_area_of_a_disc_without_holes),
        cmocka_unit_test(what_lies_outside_of_the_image_is_not_drawn),
        cmocka_unit_test(every_character_of_a_name_has_a_shape_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
