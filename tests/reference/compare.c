/* SPDX-License-Identifier: MIT */
/* Metrics of hand-made images. */
#include "app/compare/compare.h"
#include "tests/oracle/check.h"

#include <math.h>
#include <string.h>

enum { WIDTH = 16, HEIGHT = 12, VALUES = 3 * WIDTH * HEIGHT };

typedef struct pair {
    float a_values[VALUES], b_values[VALUES];
    image a, b;
} pair;

/* Two equal images with values in 0 … 1, the largest of them 1. */
static void make_pair(pair *p) {
    for (int i = 0; i < VALUES; i++)
        p->a_values[i] = p->b_values[i] = (float)((i * 37) % 101) / 100;
    p->a = (image) { WIDTH, HEIGHT, p->a_values };
    p->b = (image) { WIDTH, HEIGHT, p->b_values };
}

static compare_result compare(const pair *p, double peak) {
    compare_result result;
    cli_error error;
    assert_true(compare_images(&p->a, &p->b, peak, &result, &error));
    return result;
}

static void equal_images_have_no_difference(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    const compare_result r = compare(&p, 0);
    assert_true(r.values[COMPARE_RMSE] == 0 && r.values[COMPARE_RELMSE] == 0);
    assert_true(r.values[COMPARE_MAX] == 0 && isinf(r.values[COMPARE_PSNR]));
    CHECK_WITHIN(fabs(r.values[COMPARE_SSIM] - 1), 1e-12);
    assert_true(r.bad_values == 0);
}

static void one_changed_value_gives_the_metrics_by_hand(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    const int at = 3 * (5 * WIDTH + 7) + 2;
    p.b_values[at] = 0.5f;
    p.a_values[at] = 0.75f;
    const compare_result r = compare(&p, 0);
    CHECK_WITHIN(fabs(r.values[COMPARE_RMSE] - sqrt(0.0625 / VALUES)), 1e-12);
    CHECK_WITHIN(fabs(r.values[COMPARE_RELMSE] - 0.0625 / 0.26 / VALUES), 1e-12);
    CHECK_WITHIN(fabs(r.values[COMPARE_PSNR] - 10 * log10(VALUES / 0.0625)), 1e-9);
    CHECK_WITHIN(fabs(r.values[COMPARE_MAX] - 0.25), 1e-12);
    assert_int_equal(r.max_x, 7);
    assert_int_equal(r.max_y, 5);
}

static void the_peak_scales_psnr(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    p.a_values[0] += 0.1f;
    CHECK_WITHIN(
        fabs(compare(&p, 10).values[COMPARE_PSNR] - compare(&p, 1).values[COMPARE_PSNR] - 20),
        1e-9);
}

/* A constant offset leaves contrast and structure: SSIM is the luminance term alone. */
static void ssim_of_an_offset_is_the_luminance_term(void **state) {
    (void)state;
    pair p;
    make_pair(&p);
    for (int i = 0; i < VALUES; i++) {
        p.b_values[i] = 0.5f;
        p.a_values[i] = 0.75f;
    }
    const double c1 = 1e-4, expected = (2 * 0.5 * 0.75 + c1) / (0.25 + 0.5625 + c1);
    CHECK_WITHIN(fabs(compare(&p, 1).values[COMPARE_SSIM] - expected), 1e-9);
    for (int i = 0; i < VALUES; i++)
        p.a_values[i] = (float)((i / 3 * 7) % 2), p.b_values[i] = 1 - p.a_values[i];
    assert_true(compare(&p, 1).values[COMPARE_SSIM] < -0.5); /* inverted structure */
}

static void bad_values_poison_every_metric(void **state) {
    (void)state;
    const float bad[] = { NAN, INFINITY, -INFINITY };
    for (int i = 0; i < 6; i++) {
        pair p;
        make_pair(&p);
        (i % 2 ? p.a_values : p.b_values)[3 * (WIDTH * 3 + 4) + 1] = bad[i / 2];
        const compare_result r = compare(&p, 0);
        for (int m = 0; m < COMPARE_COUNT; m++)
            assert_true(isnan(r.values[m]));
        assert_int_equal(r.bad_values, 1);
        assert_true(r.max_x == 4 && r.max_y == 3);
    }
}

static void different_sizes_are_refused(void **state) {
    (void)state;
    pair p;
    compare_result result;
    cli_error error;
    make_pair(&p);
    p.b.height--;
    assert_false(compare_images(&p.a, &p.b, 0, &result, &error));
    assert_non_null(strstr(error.text, "16x12 and 16x11"));
}

static void a_heat_map_goes_from_black_to_white_and_marks_bad_values(void **state) {
    (void)state;
    pair p;
    unsigned char rgb8[VALUES];
    make_pair(&p);
    p.a_values[3] += 0.5f;
    p.a_values[6] += 0.25f;
    p.a_values[9] = NAN;
    compare_heat_map(&p.a, &p.b, 0, rgb8);
    assert_true(rgb8[0] == 0 && rgb8[1] == 0 && rgb8[2] == 0);
    assert_true(rgb8[3] == 255 && rgb8[4] == 255);
    assert_true(rgb8[6] > 100 && rgb8[6] < 255);
    assert_true(rgb8[9] == 0 && rgb8[10] == 255 && rgb8[11] == 0);
}

static void display_values_are_srgb(void **state) {
    (void)state;
    float values[6] = { 0, 0.002f, 0.214041f, 1, 3, -1 };
    const float expected[6] = { 0, 0.02584f, 0.5f, 1, 1, 0 };
    image pixels = { 2, 1, values };
    compare_to_display(&pixels);
    for (int i = 0; i < 6; i++)
        CHECK_WITHIN(fabsf(values[i] - expected[i]), 1e-5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_images_have_no_difference),
        cmocka_unit_test(one_changed_value_gives_the_metrics_by_hand),
        cmocka_unit_test(the_peak_scales_psnr),
        cmocka_unit_test(ssim_of_an_offset_is_the_luminance_term),
        cmocka_unit_test(bad_values_poison_every_metric),
        cmocka_unit_test(different_sizes_are_refused),
        cmocka_unit_test(a_heat_map_goes_from_black_to_white_and_marks_bad_values),
        cmocka_unit_test(display_values_are_srgb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
