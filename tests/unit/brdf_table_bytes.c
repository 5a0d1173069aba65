/* SPDX-License-Identifier: MIT */
/* Tables of BRDFs: making them in any order and without memory, and their file format. */
#include "tests/unit/brdfs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void any_order_of_tasks_makes_the_same_table(void **state) {
    (void)state;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    lmp_brdf *brdf = phong(30);
    lmp_brdf_table *serial = NULL, *shuffled = NULL;
    const lmp_brdf_table_desc desc = { .bands = 6, .views = 40 };
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &serial), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(&host, &desc, brdf, &shuffled), LMP_OK);
    assert_true(hooks.tasks > 0);
    CHECK_WITHIN(fabs(hooks.done - 1), 0);
    assert_memory_equal(lmp_brdf_table_coefficients(serial), lmp_brdf_table_coefficients(shuffled),
                        40 * 3 * 21 * sizeof(float));
    lmp_brdf_table_destroy(serial);
    lmp_brdf_table_destroy(shuffled);
    lmp_brdf_destroy(brdf);
}

static void every_failing_allocation_is_reported(void **state) {
    (void)state;
    lmp_brdf *brdf = ggx(0.6f, 0.3f);
    const lmp_brdf_table_desc desc = { .bands = 3, .views = 2, .azimuths = 4, .rings_max = 16 };
    for (int refuse = 0;; refuse++) {
        check_hooks hooks = { .refuse = refuse };
        const lmp_host host = check_host(&hooks);
        lmp_brdf_table *table = NULL;
        const lmp_result result = lmp_brdf_table_create(&host, &desc, brdf, &table);
        lmp_brdf_table_destroy(table);
        assert_int_equal(hooks.live, 0);
        if (result == LMP_OK)
            break;
        assert_int_equal(result, LMP_ERROR_MEMORY);
        assert_true(refuse < 1000);
    }
    lmp_brdf_destroy(brdf);
}

static void descriptions_out_of_range_are_refused(void **state) {
    (void)state;
    lmp_brdf *brdf = lambert(1, 1, 1);
    const lmp_brdf_table_desc descs[] = {
        { .bands = 129 },       { .bands = -1 },
        { .views = 1 },         { .views = 1025 },
        { .window_size = NAN }, { .tolerance = -1 },
        { .rings_max = 8 },     { .window = (lmp_window)9 },
    };
    for (size_t i = 0; i < sizeof descs / sizeof *descs; i++) {
        lmp_brdf_table *table = NULL;
        assert_int_equal(lmp_brdf_table_create(NULL, &descs[i], brdf, &table), LMP_ERROR_ARGUMENT);
        assert_null(table);
    }
    lmp_brdf_destroy(brdf);
}

/* --- bytes ------------------------------------------------------------------------------------ */

static unsigned char *written(const lmp_brdf *brdf, const lmp_brdf_table_desc *desc, size_t *size) {
    lmp_brdf_table *table = NULL;
    assert_int_equal(lmp_brdf_table_create(NULL, desc, brdf, &table), LMP_OK);
    *size = lmp_brdf_table_size(table);
    unsigned char *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(lmp_brdf_table_write(table, *size - 1, bytes), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_brdf_table_write(table, *size, bytes), LMP_OK);
    lmp_brdf_table_destroy(table);
    return bytes;
}

static void files_of_tables_round_trip(void **state) {
    (void)state;
    lmp_brdf *const brdfs[] = { phong(5), ggx(0.6f, 0.3f) };
    for (int i = 0; i < 2; i++) {
        const lmp_brdf_table_desc desc = {
            .bands = 4, .views = 5, .azimuths = 6, .window = LMP_WINDOW_HANNING, .rings_max = 64
        };
        size_t size = 0;
        unsigned char *bytes = written(brdfs[i], &desc, &size);
        lmp_brdf_table *copy = NULL;
        lmp_parse_error error = { 0 };
        assert_int_equal(lmp_brdf_table_read(NULL, bytes, size, &error, &copy), LMP_OK);
        const lmp_brdf_table_info info = lmp_brdf_table_describe(copy);
        assert_int_equal(info.azimuths, i == 0 ? 1 : 6);
        assert_int_equal(info.window, LMP_WINDOW_HANNING);
        assert_true(info.window_size == 4);
        assert_int_equal(lmp_brdf_table_size(copy), size);
        unsigned char *again = malloc(size);
        assert_non_null(again);
        lmp_brdf_table_write(copy, lmp_brdf_table_size(copy), again);
        assert_memory_equal(bytes, again, size);
        free(again);
        free(bytes);
        lmp_brdf_table_destroy(copy);
        lmp_brdf_destroy(brdfs[i]);
    }
}

/* Numbers of azimuths are even, and at least 4: a view past the pole is at the opposite azimuth. */
static void every_even_number_of_azimuths_is_made_and_read(void **state) {
    (void)state;
    lmp_brdf *brdf = ggx(0.6f, 0.3f);
    for (int azimuths = 2; azimuths <= 18; azimuths++) {
        const lmp_brdf_table_desc desc = {
            .bands = 2, .views = 2, .azimuths = azimuths, .rings_max = 16, .tolerance = 1
        };
        lmp_brdf_table *table = NULL, *copy = NULL;
        const bool even = azimuths >= 4 && azimuths % 2 == 0;
        assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table),
                         even ? LMP_OK : LMP_ERROR_ARGUMENT);
        if (!even)
            continue;
        unsigned char *bytes = malloc(lmp_brdf_table_size(table));
        assert_non_null(bytes);
        lmp_brdf_table_write(table, lmp_brdf_table_size(table), bytes);
        assert_int_equal(lmp_brdf_table_read(NULL, bytes, lmp_brdf_table_size(table), NULL, &copy),
                         LMP_OK);
        assert_int_equal(lmp_brdf_table_describe(copy).azimuths, azimuths);
        free(bytes);
        lmp_brdf_table_destroy(table);
        lmp_brdf_table_destroy(copy);
    }
    lmp_brdf_destroy(brdf);
}

static void damaged_tables_are_refused_with_their_reason(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(5);
    const lmp_brdf_table_desc desc = { .bands = 3, .views = 3 };
    size_t size = 0;
    unsigned char *bytes = written(brdf, &desc, &size);
    const struct {
        size_t offset, size;
        unsigned char value;
        lmp_result result;
        const char *text;
    } damages[] = {
        { 0, size, 'X', LMP_ERROR_FORMAT, "not a Lampion table" },
        { 8, size, 2, LMP_ERROR_VERSION, "version 2" },
        { 12, size, 0, LMP_ERROR_FORMAT, "bands is 0" },
        { 13, size, 1, LMP_ERROR_FORMAT, "bands is 259" },
        { 16, size, 4, LMP_ERROR_FORMAT, "need" },
        { 20, size, 3, LMP_ERROR_FORMAT, "azimuths is 3" },
        { 35, size, 0xbf, LMP_ERROR_FORMAT, "window size is not positive" },
        { 43, size, 0xbf, LMP_ERROR_FORMAT, "change is not a finite number" },
        { 60, size, 1, LMP_ERROR_CHECKSUM, "checksum" },
        { size - 1, size, 0x55, LMP_ERROR_CHECKSUM, "checksum" },
        { 0, size - 4, 'L', LMP_ERROR_FORMAT, "the file has" },
        { 0, 20, 'L', LMP_ERROR_FORMAT, "not a Lampion table" },
    };
    for (size_t i = 0; i < sizeof damages / sizeof *damages; i++) {
        const unsigned char before = bytes[damages[i].offset];
        bytes[damages[i].offset] = damages[i].value;
        lmp_brdf_table *table = NULL;
        lmp_parse_error error = { 0 };
        assert_int_equal(lmp_brdf_table_read(NULL, bytes, damages[i].size, &error, &table),
                         damages[i].result);
        assert_null(table);
        if (!strstr(error.text, damages[i].text))
            fail_msg("'%s' does not say '%s'", error.text, damages[i].text);
        bytes[damages[i].offset] = before;
    }
    free(bytes);
    lmp_brdf_destroy(brdf);
}

static void every_truncation_and_bit_of_a_table_is_noticed(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(5);
    const lmp_brdf_table_desc desc = { .bands = 2, .views = 2, .rings_max = 16 };
    size_t size = 0;
    unsigned char *bytes = written(brdf, &desc, &size);
    lmp_brdf_table *table = NULL;
    for (size_t length = 0; length < size; length++) {
        /* an exact block, so that a sanitizer sees any over-read */
        unsigned char *copy = malloc(length > 0 ? length : 1);
        assert_non_null(copy);
        memcpy(copy, bytes, length);
        assert_int_equal(lmp_brdf_table_read(NULL, copy, length, NULL, &table), LMP_ERROR_FORMAT);
        assert_null(table);
        free(copy);
    }
    for (size_t bit = 0; bit < 8 * size; bit++) {
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
        assert_int_not_equal(lmp_brdf_table_read(NULL, bytes, size, NULL, &table), LMP_OK);
        assert_null(table);
        bytes[bit / 8] = (unsigned char)(bytes[bit / 8] ^ 1u << bit % 8);
    }
    check_hooks hooks = { .refuse = 0 };
    const lmp_host host = check_host(&hooks);
    assert_int_equal(lmp_brdf_table_read(&host, bytes, size, NULL, &table), LMP_ERROR_MEMORY);
    assert_null(table);
    assert_int_equal(lmp_brdf_table_read(NULL, bytes, size, NULL, &table), LMP_OK);
    lmp_brdf_table_destroy(table);
    free(bytes);
    lmp_brdf_destroy(brdf);
}

static void every_failing_allocation_of_a_projection_is_reported(void **state) {
    (void)state;
    lmp_brdf *brdf = phong(5);
    float sh[12];
    for (int refuse = 0; refuse < 3; refuse++) {
        check_hooks hooks = { .refuse = refuse };
        const lmp_host host = check_host(&hooks);
        const lmp_vec3 up = { 0, 0, 1 };
        assert_int_equal(lmp_brdf_project(&host, 2, 16, brdf, up, sh),
                         refuse < 2 ? LMP_ERROR_MEMORY : LMP_OK);
        assert_int_equal(hooks.live, 0);
    }
    lmp_brdf_destroy(brdf);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_order_of_tasks_makes_the_same_table),
        cmocka_unit_test(every_failing_allocation_is_reported),
        cmocka_unit_test(descriptions_out_of_range_are_refused),
        cmocka_unit_test(files_of_tables_round_trip),
        cmocka_unit_test(every_even_number_of_azimuths_is_made_and_read),
        cmocka_unit_test(damaged_tables_are_refused_with_their_reason),
        cmocka_unit_test(every_truncation_and_bit_of_a_table_is_noticed),
        cmocka_unit_test(every_failing_allocation_of_a_projection_is_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
