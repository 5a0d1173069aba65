/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"

#include <lampion/sh.h>

#include <math.h>

static void hanning_and_lanczos_give_the_known_weights(void **state) {
    (void)state;
    const double hanning[] = { 1, .9755, .9045, .7939, .6545, .5, .3455, .2061, .0955, .0245 };
    const double lanczos[] = { 1, .9836, .9355, .8584, .7568, .6366, .5046, .3679, .2339, .1093 };
    float weights[10];
    lmp_sh_make_window(10, LMP_WINDOW_HANNING, 0, weights);
    for (int l = 0; l < 10; l++)
        CHECK_WITHIN(fabs((double)weights[l] - hanning[l]), 5.1e-5);
    lmp_sh_make_window(10, LMP_WINDOW_LANCZOS, 10, weights);
    for (int l = 0; l < 10; l++)
        CHECK_WITHIN(fabs((double)weights[l] - lanczos[l]), 5.1e-5);
    lmp_sh_make_window(10, LMP_WINDOW_NONE, 3, weights);
    for (int l = 0; l < 10; l++)
        assert_true(weights[l] == 1);
}

static void windows_have_names_up_to_the_last(void **state) {
    (void)state;
    assert_string_equal(lmp_sh_window_name(LMP_WINDOW_NONE), "none");
    assert_string_equal(lmp_sh_window_name(LMP_WINDOW_HANNING), "hanning");
    assert_string_equal(lmp_sh_window_name(LMP_WINDOW_LANCZOS), "lanczos");
    assert_null(lmp_sh_window_name(LMP_WINDOW_COUNT));
    assert_null(lmp_sh_window_name((lmp_window)-1));
}

static void falls_to_zero_at_its_size_and_stays_there(void **state) {
    (void)state;
    const lmp_window kinds[] = { LMP_WINDOW_HANNING, LMP_WINDOW_LANCZOS };
    float weights[LMP_BANDS_MAX];
    for (int k = 0; k < 2; k++) {
        const float sizes[] = { 6.5f, 7 };
        for (int i = 0; i < 2; i++) {
            lmp_sh_make_window(LMP_BANDS_MAX, kinds[k], sizes[i], weights);
            for (int l = 0; l < LMP_BANDS_MAX; l++)
                assert_true(l < 7 ? weights[l] > 0 : weights[l] == 0);
        }
        /* The window of all bands falls, and is positive up to the last of them. */
        lmp_sh_make_window(LMP_BANDS_MAX, kinds[k], 0, weights);
        for (int l = 1; l < LMP_BANDS_MAX; l++)
            assert_true(weights[l] > 0 && weights[l] < weights[l - 1]);
        CHECK_WITHIN(fabsf(weights[LMP_BANDS_MAX - 1]), 0.01);
    }
}

static double squared_laplacian(int bands, const float *sh) {
    double sum = 0;
    for (int l = 0; l < bands; l++)
        for (int m = -l; m <= l; m++)
            sum += pow((double)l * (l + 1) * (double)sh[LMP_SH_INDEX(l, m)], 2);
    return sum;
}

static void minimum_laplacian_keeps_the_asked_fraction(void **state) {
    (void)state;
    const float keeps[] = { 0.999f, 0.5f, 0.1f, 1e-4f };
    float sh[400], weights[20], windowed[400];
    for (int k = 0; k < 400; k++)
        sh[k] = (float)check_random_between(-1, 1);
    for (int i = 0; i < 4; i++) {
        lmp_sh_make_laplacian_window(20, keeps[i], sh, weights);
        lmp_sh_apply_window(20, weights, sh, windowed);
        const double kept = squared_laplacian(20, windowed) / squared_laplacian(20, sh);
        CHECK_WITHIN(fabs(kept / (double)keeps[i] - 1), 1e-5);
        /* The weights have the form 1 / (1 + mu l²(l+1)²), with mu taken from band 1. */
        const double mu = (1 / (double)weights[1] - 1) / 4;
        for (int l = 2; l < 20; l++) {
            const double eigenvalue = (double)l * (l + 1);
            const double expected = 1 / (1 + mu * eigenvalue * eigenvalue);
            if (mu > 1e-3)
                CHECK_WITHIN(fabs((double)weights[l] / expected - 1), 1e-3);
            assert_true(weights[l] < weights[l - 1]);
        }
    }
}

static void minimum_laplacian_leaves_alone_what_needs_no_window(void **state) {
    (void)state;
    float weights[4];
    const float constant[16] = { 3 };
    lmp_sh_make_laplacian_window(4, 0.5f, constant, weights);
    for (int l = 0; l < 4; l++)
        assert_true(weights[l] == 1);
    float sh[16];
    for (int k = 0; k < 16; k++)
        sh[k] = 1;
    lmp_sh_make_laplacian_window(4, 1, sh, weights);
    for (int l = 0; l < 4; l++)
        assert_true(weights[l] == 1);
}

static void applies_onto_its_own_input(void **state) {
    (void)state;
    const float weights[3] = { 1, 0.5f, 0.25f };
    float sh[9] = { 1, 1, 1, 1, 1, 1, 1, 1, 1 };
    lmp_sh_apply_window(3, weights, sh, sh);
    for (int k = 0; k < 9; k++)
        assert_true(sh[k] == weights[k == 0 ? 0 : k < 4 ? 1 : 2]);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_have_names_up_to_the_last),
        cmocka_unit_test(hanning_and_lanczos_give_the_known_weights),
        cmocka_unit_test(falls_to_zero_at_its_size_and_stays_there),
        cmocka_unit_test(minimum_laplacian_keeps_the_asked_fraction),
        cmocka_unit_test(minimum_laplacian_leaves_alone_what_needs_no_window),
        cmocka_unit_test(applies_onto_its_own_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
