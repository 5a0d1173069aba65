/* SPDX-License-Identifier: MIT */
/* Other ways to compute zonal coefficients, and why the library does not use them. */
#include "app/render/zonal.h"
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/light.h>

#include <math.h>

static void the_printed_equation_agrees_for_large_lights(void **state) {
    (void)state;
    double expected[30];
    float zonal[30];
    for (int i = 0; i <= 20; i++) {
        const float cosine = -1 + 0.09f * (float)i;
        oracle_cap_zonal(30, 1 - (double)cosine, expected);
        zonal_printed(30, cosine, zonal);
        CHECK_WITHIN(check_error(30, expected, zonal), 1e-4);
    }
}

static void the_closed_forms_agree_up_to_six_bands(void **state) {
    (void)state;
    double expected[6];
    for (int bands = 1; bands <= ZONAL_SLOAN_BANDS; bands++) {
        for (int i = 0; i <= 20; i++) {
            float zonal[6] = { 7, 7, 7, 7, 7, 7 };
            const float cosine = -1 + 0.09999f * (float)i;
            oracle_cap_zonal(bands, 1 - (double)cosine, expected);
            zonal_sloan(bands, cosine, zonal);
            CHECK_WITHIN(check_error((size_t)bands, expected, zonal), 2e-6);
            if (bands < 6)
                assert_true(zonal[bands] == 7);
        }
    }
}

static void the_table_converges_with_its_size(void **state) {
    (void)state;
    double before = (double)INFINITY;
    for (int size = 64; size <= 4096; size *= 4) {
        zonal_table *table = zonal_table_create(10, size);
        assert_non_null(table);
        double worst = 0;
        for (int i = 0; i <= 500; i++) {
            const float cosine = -1 + 0.004f * (float)i;
            double expected[10];
            float zonal[10];
            oracle_cap_zonal(10, 1 - (double)cosine, expected);
            zonal_table_eval(table, fminf(cosine, 1), zonal);
            for (int l = 0; l < 10; l++)
                worst = fmax(worst, fabs((double)zonal[l] - expected[l]));
        }
        CHECK_WITHIN(worst, before / 4);
        before = worst;
        zonal_table_destroy(table);
    }
    CHECK_WITHIN(before, 2e-5);
}

static void the_table_is_exact_at_its_ends(void **state) {
    (void)state;
    zonal_table *table = zonal_table_create(6, 2);
    float zonal[6];
    assert_non_null(table);
    zonal_table_eval(table, 1, zonal);
    for (int l = 0; l < 6; l++)
        CHECK_WITHIN(fabsf(zonal[l]), 1e-6);
    zonal_table_eval(table, -1, zonal);
    CHECK_WITHIN(fabs((double)zonal[0] - 2 * sqrt(ORACLE_PI)), 1e-6);
    for (int l = 1; l < 6; l++)
        CHECK_WITHIN(fabsf(zonal[l]), 1e-6);
    zonal_table_destroy(table);
}

static void the_table_reads_inside_whatever_the_cosine(void **state) {
    (void)state;
    const float cosines[] = { -INFINITY, -2, 2, INFINITY, NAN };
    zonal_table *table = zonal_table_create(5, 10);
    float zonal[5], ends[2][5];
    assert_non_null(table);
    zonal_table_eval(table, -1, ends[0]);
    zonal_table_eval(table, 1, ends[1]);
    for (int i = 0; i < 5; i++) {
        zonal_table_eval(table, cosines[i], zonal);
        for (int l = 0; l < 5; l++)
            if (i < 4)
                CHECK_WITHIN(fabsf(zonal[l] - ends[i / 2][l]), 1e-6);
            else
                assert_true(isnan(zonal[l]));
    }
    zonal_table_destroy(table);
}

/* The reason for the recurrence by differences, in one number. */
static void small_lights_need_the_difference_form(void **state) {
    (void)state;
    double expected[10];
    float printed[10], stable[10];
    oracle_cap_zonal(10, 1e-6 / (1 + sqrt(1 - 1e-6)), expected);
    zonal_printed(10, sqrtf(1 - 1e-6f), printed);
    lmp_sphere_project_zonal(10, 1e-3f, 1, stable);
    assert_true(check_error(10, expected, printed) > 1e-2);
    CHECK_WITHIN(check_error(10, expected, stable), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_equation_agrees_for_large_lights),
        cmocka_unit_test(the_closed_forms_agree_up_to_six_bands),
        cmocka_unit_test(the_table_converges_with_its_size),
        cmocka_unit_test(the_table_is_exact_at_its_ends),
        cmocka_unit_test(the_table_reads_inside_whatever_the_cosine),
        cmocka_unit_test(small_lights_need_the_difference_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
