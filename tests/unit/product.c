/* SPDX-License-Identifier: MIT */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/sh.h>

#include <math.h>
#include <stdlib.h>

typedef struct factors {
    int bands;
    const float *a, *b;
    double y[400];
} factors;

static double pair_value(const double w[3], void *user) {
    factors *pair = user;
    double a = 0, b = 0;
    oracle_sh_eval(pair->bands, w, pair->y);
    for (int k = 0; k < pair->bands * pair->bands; k++) {
        a += pair->y[k] * (double)pair->a[k];
        b += pair->y[k] * (double)pair->b[k];
    }
    return a * b;
}

/* Checks a vector file, whose rows hold a, b and their product; NULL means the form for few bands.
 */
static void check_vector_file(const char *name, int bands, const lmp_sh_product *product,
                              double bound) {
    enum { MOST = LMP_SH_COUNT(12) };
    const int count = bands * bands;
    check_csv *csv = check_csv_open(name);
    for (int row = 0; row < csv->rows; row++) {
        double in[2 * MOST], expected[MOST];
        float a[MOST], b[MOST], c[MOST];
        check_csv_numbers(csv, row, 0, 2 * count, in);
        check_csv_numbers(csv, row, 2 * count, count, expected);
        for (int k = 0; k < count; k++) {
            a[k] = (float)in[k];
            b[k] = (float)in[count + k];
        }
        if (product)
            lmp_sh_multiply(product, a, b, c);
        else
            lmp_sh_multiply_few(bands, a, b, c);
        CHECK_WITHIN(check_error((size_t)count, expected, c), bound);
    }
    check_csv_close(csv);
}

static void multiplies_the_vector_file(void **state) {
    (void)state;
    check_vector_file("product.csv", LMP_SH_FEW_BANDS, NULL, 2e-6);
}

static void multiplies_12_bands_as_the_vector_file_says(void **state) {
    (void)state;
    lmp_sh_product *product;
    assert_int_equal(lmp_sh_product_create(NULL, 12, &product), LMP_OK);
    check_vector_file("product_12.csv", 12, product, 5e-6);
    lmp_sh_product_destroy(product);
}

static void multiplies_as_quadrature_does(void **state) {
    (void)state;
    for (int bands = 1; bands <= 12; bands++) {
        float a[144], b[144], c[144];
        double expected[144];
        for (int k = 0; k < bands * bands; k++) {
            a[k] = (float)check_random_between(-1, 1);
            b[k] = (float)check_random_between(-1, 1);
        }
        factors pair = { .bands = bands, .a = a, .b = b };
        oracle_project(bands, pair_value, &pair, 2 * bands, expected);
        lmp_sh_product *product;
        assert_int_equal(lmp_sh_product_create(NULL, bands, &product), LMP_OK);
        lmp_sh_multiply(product, a, b, c);
        CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, c), 5e-6);
        lmp_sh_product_destroy(product);
        if (bands > LMP_SH_FEW_BANDS)
            continue;
        float few[144];
        lmp_sh_multiply_few(bands, a, b, few);
        assert_memory_equal(few, c, LMP_SH_COUNT(bands) * sizeof *c);
        const float nothing[LMP_SH_COUNT(LMP_SH_FEW_BANDS)] = { 0 };
        lmp_sh_multiply_few(bands, nothing, b, few);
        for (size_t k = 0; k < LMP_SH_COUNT(bands); k++)
            assert_true(few[k] == 0);
    }
}

static void by_one_changes_nothing_at_128_bands(void **state) {
    (void)state;
    enum { COUNT = LMP_BANDS_MAX * LMP_BANDS_MAX };
    static float one[COUNT], b[COUNT], c[COUNT];
    static double expected[COUNT];
    one[0] = (float)(2 * sqrt(ORACLE_PI));
    for (int k = 0; k < COUNT; k++) {
        b[k] = (float)check_random_between(-1, 1);
        expected[k] = (double)b[k];
    }
    lmp_sh_product *product;
    assert_int_equal(lmp_sh_product_create(NULL, LMP_BANDS_MAX, &product), LMP_OK);
    lmp_sh_multiply(product, one, b, c);
    CHECK_WITHIN(check_error(COUNT, expected, c), 2e-5);
    lmp_sh_product_destroy(product);
}

static void refuses_impossible_bands(void **state) {
    (void)state;
    const int counts[] = { 0, -1, LMP_BANDS_MAX + 1 };
    for (int i = 0; i < 3; i++) {
        lmp_sh_product *product = (lmp_sh_product *)1;
        assert_int_equal(lmp_sh_product_create(NULL, counts[i], &product), LMP_ERROR_ARGUMENT);
        assert_null(product);
    }
    lmp_sh_product_destroy(NULL);
}

static void gives_back_all_memory_whichever_request_fails(void **state) {
    (void)state;
    const int counts[] = { 3, 9 }, requests[] = { 1, 3 };
    for (int i = 0; i < 2; i++) {
        for (int refuse = 0;; refuse++) {
            check_hooks hooks = { .refuse = refuse };
            const lmp_host host = check_host(&hooks);
            lmp_sh_product *product = (lmp_sh_product *)1;
            const lmp_result result = lmp_sh_product_create(&host, counts[i], &product);
            const int refused = hooks.requests > refuse;
            assert_int_equal(result, refused ? LMP_ERROR_MEMORY : LMP_OK);
            assert_true(refused == (product == NULL));
            lmp_sh_product_destroy(product);
            assert_int_equal(hooks.live, 0);
            if (!refused) {
                assert_true(refuse >= requests[i]);
                break;
            }
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(multiplies_the_vector_file),
        cmocka_unit_test(multiplies_12_bands_as_the_vector_file_says),
        cmocka_unit_test(multiplies_as_quadrature_does),
        cmocka_unit_test(by_one_changes_nothing_at_128_bands),
        cmocka_unit_test(refuses_impossible_bands),
        cmocka_unit_test(gives_back_all_memory_whichever_request_fails),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
