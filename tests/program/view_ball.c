/* SPDX-License-Identifier: MIT */
/* The ball that shows what a material looks like. */
#include "app/image/srgb.h"
#include "app/view/ball.h"
#include "tests/oracle/check.h"

#include <math.h>

static view_ball ball;

/* The luminance where the ball is, as fractions of its size from the upper left corner. */
static double at(double x, double y) {
    const int column = (int)(x * VIEW_BALL_SIZE), row = (int)(y * VIEW_BALL_SIZE);
    return image_luminance(ball.rgb + 3 * (row * VIEW_BALL_SIZE + column));
}

static void it_is_round_and_lit_from_the_upper_left(void **state) {
    (void)state;
    assert_true(view_ball_draw(&ball, "lambert:0.5"));
    for (int i = 0; i < VIEW_BALL_SIZE * VIEW_BALL_SIZE; i++) {
        const double x = (i % VIEW_BALL_SIZE + 0.5) / VIEW_BALL_SIZE - 0.5;
        const double y = (i / VIEW_BALL_SIZE + 0.5) / VIEW_BALL_SIZE - 0.5;
        assert_int_equal(ball.rgb[3 * i] < 0, x * x + y * y >= 0.25);
    }
    assert_true(at(0.35, 0.3) > 2 * at(0.65, 0.8) && at(0.65, 0.8) > 0);
    const double half = at(0.5, 0.5);
    assert_true(view_ball_draw(&ball, "lambert:0.25"));
    CHECK_WITHIN(fabs(at(0.5, 0.5) - 0.5 * half), 1e-6);
}

static void a_smoother_one_has_a_smaller_highlight(void **state) {
    (void)state;
    assert_true(view_ball_draw(&ball, "gltf:0.8:1:1"));
    const double rough = at(0.35, 0.3) / at(0.5, 0.7);
    assert_true(view_ball_draw(&ball, "gltf:0.8:0.4:1"));
    assert_true(at(0.35, 0.3) / at(0.5, 0.7) > 2 * rough);
}

static void what_cannot_be_drawn_is_not(void **state) {
    (void)state;
    assert_false(view_ball_draw(&ball, "no-such-file.binary"));
    assert_false(view_ball_draw(&ball, "no-such-file.binary"));
    assert_true(view_ball_draw(&ball, "sgd:brass"));
    const lmp_rgb brass = { ball.rgb[3444], ball.rgb[3445], ball.rgb[3446] }; /* its middle */
    assert_true(brass.r > brass.g && brass.g > brass.b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_round_and_lit_from_the_upper_left),
        cmocka_unit_test(a_smoother_one_has_a_smaller_highlight),
        cmocka_unit_test(what_cannot_be_drawn_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
