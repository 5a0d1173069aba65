/* SPDX-License-Identifier: MIT */
/* The other ways to the zonal coefficients, and why the library does not take them. */
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
        lmp_zonal_printed(30, cosine, zonal);
        CHECK_WITHIN(check_error(30, expected, zonal), 1e-4);
    }
}

static void the_closed_forms_agree_up_to_six_bands(void **state) {
    (void)state;
    double expected[6];
    for (int bands = 1; bands <= LMP_ZONAL_SLOAN_BANDS; bands++) {
        for (int i = 0; i <= 20; i++) {
            float zonal[6] = { 7, 7, 7, 7, 7, 7 };
            const float cosine = -1 + 0.09999f * (float)i;
            oracle_cap_zonal(bands, 1 - (double)cosine, expected);
            lmp_zonal_sloan(bands, cosine, zonal);
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
        lmp_zonal_table *table;
        assert_int_equal(lmp_zonal_table_create(NULL, 10, size, &table), LMP_OK);
        double worst = 0;
        for (int i = 0; i <= 500; i++) {
            const float cosine = -1 + 0.004f * (float)i;
            double expected[10];
            float zonal[10];
            oracle_cap_zonal(10, 1 - (double)cosine, expected);
            lmp_zonal_table_eval(table, fminf(cosine, 1), zonal);
            for (int l = 0; l < 10; l++)
                worst = fmax(worst, fabs((double)zonal[l] - expected[l]));
        }
        CHECK_WITHIN(worst, before / 4);
        before = worst;
        lmp_zonal_table_destroy(table);
    }
    CHECK_WITHIN(before, 2e-5);
}

static void the_table_is_exact_at_its_ends(void **state) {
    (void)state;
    lmp_zonal_table *table;
    float zonal[6];
    assert_int_equal(lmp_zonal_table_create(NULL, 6, 2, &table), LMP_OK);
    lmp_zonal_table_eval(table, 1, zonal);
    for (int l = 0; l < 6; l++)
        CHECK_WITHIN(fabsf(zonal[l]), 1e-6);
    lmp_zonal_table_eval(table, -1, zonal);
    CHECK_WITHIN(fabs((double)zonal[0] - 2 * sqrt(ORACLE_PI)), 1e-6);
    for (int l = 1; l < 6; l++)
        CHECK_WITHIN(fabsf(zonal[l]), 1e-6);
    lmp_zonal_table_destroy(table);
}

static void the_table_refuses_impossible_sizes(void **state) {
    (void)state;
    const int cases[][2] = { { 0, 100 }, { LMP_BANDS_MAX + 1, 100 }, { 5, 1 }, { 5, -3 } };
    for (int i = 0; i < 4; i++) {
        lmp_zonal_table *table = (lmp_zonal_table *)1;
        assert_int_equal(lmp_zonal_table_create(NULL, cases[i][0], cases[i][1], &table),
                         LMP_ERROR_ARGUMENT);
        assert_null(table);
    }
    lmp_zonal_table_destroy(NULL);
}

static void the_table_gives_back_all_memory_whichever_request_fails(void **state) {
    (void)state;
    for (int refuse = 0; refuse < 3; refuse++) {
        check_heap heap = { .refuse = refuse };
        const lmp_allocator allocator = check_allocator(&heap);
        lmp_zonal_table *table;
        const lmp_result result = lmp_zonal_table_create(&allocator, 5, 10, &table);
        assert_int_equal(result, refuse < 2 ? LMP_ERROR_MEMORY : LMP_OK);
        lmp_zonal_table_destroy(table);
        assert_int_equal(heap.live, 0);
    }
}

/* The reason for the recurrence by differences, in one number. */
static void small_lights_need_the_difference_form(void **state) {
    (void)state;
    double expected[10];
    float printed[10], stable[10];
    oracle_cap_zonal(10, 1e-6 / (1 + sqrt(1 - 1e-6)), expected);
    lmp_zonal_printed(10, sqrtf(1 - 1e-6f), printed);
    lmp_sphere_zonal(10, 1e-3f, 1, stable);
    assert_true(check_error(10, expected, printed) > 1e-2);
    CHECK_WITHIN(check_error(10, expected, stable), 1e-6);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_equation_agrees_for_large_lights),
        cmocka_unit_test(the_closed_forms_agree_up_to_six_bands),
        cmocka_unit_test(the_table_converges_with_its_size),
        cmocka_unit_test(the_table_is_exact_at_its_ends),
        cmocka_unit_test(the_table_refuses_impossible_sizes),
        cmocka_unit_test(the_table_gives_back_all_memory_whichever_request_fails),
        cmocka_unit_test(small_lights_need_the_difference_form),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
