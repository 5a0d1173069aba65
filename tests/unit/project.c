/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

/* --- any function ----------------------------------------------------------------------------- */

typedef struct series {
    int bands;
    const float *sh;
} series;

static float series_value(lmp_vec3 direction, void *user) {
    const series *f = user;
    return lmp_sh_reconstruct(f->bands, f->sh, direction);
}

static void returns_the_coefficients_of_a_series(void **state) {
    (void)state;
    const int counts[] = { 1, 2, 5, 12, 30 };
    static float sh[900], projected[900];
    static double expected[900];
    for (int i = 0; i < 5; i++) {
        const int bands = counts[i];
        for (int k = 0; k < bands * bands; k++) {
            sh[k] = (float)check_random_between(-1, 1);
            expected[k] = (double)sh[k];
        }
        series f = { bands, sh };
        lmp_sh_project_function(bands, series_value, &f, 0, projected);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, projected), 1e-4);
        lmp_sh_project_function(bands, series_value, &f, bands + 3, projected);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, projected), 1e-4);
    }
}

static void is_exact_up_to_the_documented_degree(void **state) {
    (void)state;
    /* a function of degree 15 seen through 4 bands needs 2 nodes - 4 >= 15: 10 nodes */
    float sh[256], projected[16];
    double expected[16];
    for (int k = 0; k < 256; k++)
        sh[k] = (float)check_random_between(-1, 1);
    for (int k = 0; k < 16; k++)
        expected[k] = (double)sh[k];
    series f = { 16, sh };
    lmp_sh_project_function(4, series_value, &f, 10, projected);
    CHECK_WITHIN(check_error(16, expected, projected), 1e-5);
    lmp_sh_project_function(4, series_value, &f, 8, projected);
    assert_true(check_error(16, expected, projected) > 1e-3);
}

static float constant(lmp_vec3 direction, void *user) {
    (void)direction;
    ++*(int *)user;
    return 1;
}

static void calls_the_function_as_often_as_documented(void **state) {
    (void)state;
    int calls = 0;
    float sh[16];
    lmp_sh_project_function(4, constant, &calls, 7, sh);
    assert_int_equal(calls, 2 * 7 * 7);
    CHECK_WITHIN(fabs((double)sh[0] - 2 * sqrt(ORACLE_PI)), 1e-6);
    for (int k = 1; k < 16; k++)
        CHECK_WITHIN(fabsf(sh[k]), 1e-6);
    static float all[LMP_BANDS_MAX * LMP_BANDS_MAX];
    lmp_sh_project_function(LMP_BANDS_MAX, constant, &calls, 0, all);
    CHECK_WITHIN(fabs((double)all[0] - 2 * sqrt(ORACLE_PI)), 1e-5);
    for (int k = 1; k < LMP_BANDS_MAX * LMP_BANDS_MAX; k++)
        CHECK_WITHIN(fabsf(all[k]), 1e-4);
}

/* --- images --------------------------------------------------------------------------------- */

/* The direction of a pixel's center by the words of the header. */
static void pixel_direction(int width, int height, int row, int column, double w[3]) {
    const double polar = ORACLE_PI * (row + 0.5) / height;
    const double azimuth = 2 * ORACLE_PI * (column + 0.5) / width - ORACLE_PI;
    w[0] = sin(polar) * sin(azimuth);
    w[1] = cos(polar);
    w[2] = -sin(polar) * cos(azimuth);
}

static void a_constant_image_is_a_constant(void **state) {
    (void)state;
    enum { WIDTH = 64, HEIGHT = 32 };
    static float pixels[WIDTH * HEIGHT], sh[25];
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        pixels[i] = 0.5f;
    lmp_sh_project_latlong(5, pixels, WIDTH, HEIGHT, 1, 0, sh);
    CHECK_WITHIN(fabs((double)sh[0] - sqrt(ORACLE_PI)), 1e-6);
    /* the pixels' own size is left in the others: of order 1/height² */
    for (int k = 1; k < 25; k++)
        CHECK_WITHIN(fabsf(sh[k]), 1e-2);
    for (int m = -1; m <= 1; m++)
        CHECK_WITHIN(fabsf(sh[LMP_SH_INDEX(1, m)]), 1e-6);
}

static void a_image_of_a_cosine_is_a_cosine(void **state) {
    (void)state;
    enum { WIDTH = 256, HEIGHT = 128, CHANNELS = 6 };
    float *pixels = malloc(sizeof(float) * (WIDTH * CHANNELS + 5) * HEIGHT);
    assert_non_null(pixels);
    static float sh[CHANNELS * 9];
    double w[3];
    /* channels 0-2: the coordinates of the direction, 3-5: their negatives; rows are padded */
    for (int row = 0; row < HEIGHT; row++) {
        for (int column = 0; column < WIDTH; column++) {
            pixel_direction(WIDTH, HEIGHT, row, column, w);
            for (int k = 0; k < CHANNELS; k++)
                pixels[row * (WIDTH * CHANNELS + 5) + column * CHANNELS + k] =
                    (float)(k < 3 ? w[k] : -w[k - 3]);
        }
    }
    lmp_sh_project_latlong(3, pixels, WIDTH, HEIGHT, CHANNELS,
                           sizeof(float) * (WIDTH * CHANNELS + 5), sh);
    free(pixels);
    /* x, y, z are the places 3, 1, 2 with the signs -, -, + */
    const int places[3] = { 3, 1, 2 };
    const double signs[3] = { -1, -1, 1 };
    for (int channel = 0; channel < CHANNELS; channel++) {
        double expected[9] = { 0 };
        const int axis = channel % 3;
        expected[places[axis]] = signs[axis] * sqrt(4 * ORACLE_PI / 3) * (channel < 3 ? 1 : -1);
        CHECK_WITHIN(check_error(9, expected, sh + 9 * channel), 1e-3);
    }
}

static void the_middle_of_an_image_is_towards_minus_z(void **state) {
    (void)state;
    enum { WIDTH = 33, HEIGHT = 17 };
    static float pixels[WIDTH * HEIGHT], sh[16];
    pixels[HEIGHT / 2 * WIDTH + WIDTH / 2] = 1;
    lmp_sh_project_latlong(4, pixels, WIDTH, HEIGHT, 1, 0, sh);
    const double w[3] = { 0, 0, -1 };
    double expected[16];
    oracle_sh_eval(4, w, expected);
    const double polar = ORACLE_PI * (HEIGHT / 2) / HEIGHT;
    const double solid_angle =
        (cos(polar) - cos(polar + ORACLE_PI / HEIGHT)) * 2 * ORACLE_PI / WIDTH;
    for (int k = 0; k < 16; k++)
        expected[k] *= solid_angle;
    CHECK_WITHIN(check_error(16, expected, sh), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(returns_the_coefficients_of_a_series),
        cmocka_unit_test(is_exact_up_to_the_documented_degree),
        cmocka_unit_test(calls_the_function_as_often_as_documented),
        cmocka_unit_test(a_constant_image_is_a_constant),
        cmocka_unit_test(a_image_of_a_cosine_is_a_cosine),
        cmocka_unit_test(the_middle_of_an_image_is_towards_minus_z),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
