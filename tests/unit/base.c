/* SPDX-License-Identifier: MIT */
#include "src/base/bytes.h"
#include "tests/oracle/check.h"

#include "src/base/tables.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void every_result_has_a_text_of_its_own(void **state) {
    (void)state;
    for (int i = LMP_OK; i <= LMP_ERROR_CHECKSUM; i++)
        for (int j = LMP_OK; j < i; j++)
            assert_string_not_equal(lmp_result_text((lmp_result)i), lmp_result_text((lmp_result)j));
    assert_non_null(lmp_result_text((lmp_result)99));
}

static void the_version_is_that_of_the_header(void **state) {
    (void)state;
    assert_int_equal(lmp_version() >> 16, LMP_VERSION_MAJOR);
    assert_int_equal(lmp_version() >> 8 & 0xff, LMP_VERSION_MINOR);
    assert_int_equal(lmp_version() & 0xff, LMP_VERSION_PATCH);
}

static void the_triangular_index_counts_through_the_table(void **state) {
    (void)state;
    size_t next = 0;
    for (int m = 0; m < LMP_BANDS_MAX; m++)
        for (int l = m; l < LMP_BANDS_MAX; l++)
            assert_int_equal(lmpi_table_index(l, m), next++);
    assert_int_equal(next, LMPI_TABLE_COUNT);
}

/* Both forms of the recurrence are the same numbers: N_lm (z q - b q') = A z Y + B Y'. */
static void the_tables_agree_with_one_another(void **state) {
    (void)state;
    for (int m = 0; m < LMP_BANDS_MAX; m++) {
        for (int l = m; l < LMP_BANDS_MAX; l++) {
            const size_t i = lmpi_table_index(l, m);
            const double a = (double)lmpi_table_a[i], n = (double)lmpi_table_norm[i];
            assert_true(isfinite(n));
            if (l == m) {
                assert_true(lmpi_table_norm[i] == lmpi_table_diagonal[m]);
                continue;
            }
            CHECK_WITHIN(fabs(n / ((double)lmpi_table_norm[i - 1] * a) - 1), 3e-7);
            if (l < m + 2)
                continue;
            const double b = -n * (double)lmpi_table_monic[i] / (double)lmpi_table_norm[i - 2];
            CHECK_WITHIN(fabs(b - (double)lmpi_table_b[i]), 1e-6);
        }
    }
    for (int l = 0; l < LMP_BANDS_MAX; l++) {
        float product = lmpi_table_diagonal[0];
        for (int k = 1; k <= l; k++)
            product *= sqrtf((2 * (float)k + 1) / (2 * (float)k - 1));
        CHECK_WITHIN(fabsf(lmpi_table_pole[l] / product - 1), 2e-5);
    }
}

/* Checksums are compared with the definition at sizes where one run, many runs and three runs at
 * once are taken. */
static void checksums_are_those_of_the_definition(void **state) {
    (void)state;
    enum { LONGEST = 120000 };
    unsigned char *bytes = malloc(LONGEST);
    assert_non_null(bytes);
    for (int i = 0; i < LONGEST; i++)
        bytes[i] = (unsigned char)(check_random() * 256);
    const size_t sizes[] = { 0, 1, 15, 16, 17, 8192, 24575, 24576, 24577, 49152, 73741, LONGEST };
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        uint32_t crc = 0xffffffffu;
        for (size_t i = 0; i < sizes[k]; i++) {
            crc ^= bytes[i];
            for (int bit = 0; bit < 8; bit++)
                crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78u : 0);
        }
        assert_int_equal(lmpi_bytes_checksum(bytes, sizes[k]), ~crc);
    }
    free(bytes);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checksums_are_those_of_the_definition),
        cmocka_unit_test(every_result_has_a_text_of_its_own),
        cmocka_unit_test(the_version_is_that_of_the_header),
        cmocka_unit_test(the_triangular_index_counts_through_the_table),
        cmocka_unit_test(the_tables_agree_with_one_another),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
