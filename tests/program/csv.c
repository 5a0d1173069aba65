/* SPDX-License-Identifier: MIT */
/* Tables of numbers: app/base/csv.h. */
#include "app/base/csv.h"
#include "tests/oracle/check.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static void expect_as_printf(float value) {
    char text[CSV_TEXT_MAX + 1], expected[64];
    text[csv_format(value, text)] = '\0';
    snprintf(expected, sizeof expected, "%.9g", (double)value);
    if (strcmp(text, expected) != 0)
        fail_msg("%a: %s, printf says %s", (double)value, text, expected);
    if (strtof(text, NULL) != value)
        fail_msg("%s does not come back as %a", text, (double)value);
}

static void floats_are_printed_as_printf_does(void **state) {
    (void)state;
    static const float chosen[] = {
        1.0f,         -1.0f,    9.5f,  0.1f,          0.0001f,       0.00001f,      99999.9999f,
        1e8f,         1e9f,     1e10f, 123456.0f,     FLT_MAX,       FLT_MIN,       FLT_TRUE_MIN,
        999999936.0f, 1e-38f,   1e38f, 16777216,      16777215,      0.5f,          3.14159274f,
        1.00000012f,  -1234.5f, 1e-4f, 9.9999997e-5f, 2147483648.0f, 4294967296.0f,
    };
    for (size_t i = 0; i < sizeof chosen / sizeof chosen[0]; i++)
        expect_as_printf(chosen[i]);
    for (int exponent = -149; exponent < 128; exponent++)
        expect_as_printf(ldexpf(1.0f, exponent));
    uint64_t bits = 88172645463325252u; /* xorshift */
    for (int i = 0; i < 300000; i++) {
        bits ^= bits << 13;
        bits ^= bits >> 7;
        bits ^= bits << 17;
        const uint32_t pattern = (uint32_t)(bits >> 32);
        float value;
        memcpy(&value, &pattern, sizeof value);
        if (isfinite(value) && value != 0.0f)
            expect_as_printf(value);
        expect_as_printf((float)(bits % 2000000 + 1) / 1024.0f);
    }
}

static void zero_has_no_sign(void **state) {
    (void)state;
    char text[CSV_TEXT_MAX];
    assert_int_equal(csv_format(0.0f, text), 1);
    assert_int_equal(text[0], '0');
    assert_int_equal(csv_format(-0.0f, text), 1);
    assert_int_equal(text[0], '0');
}

static const char *const names[] = { "a", "b" };

/* Reads a table of two columns to its end; returns the sum of its rows, and how reading ended. */
static float read_table(const void *bytes, size_t size, csv_result *result, base_error *error) {
    char path[] = "/tmp/lampion-csv-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *const file = fdopen(descriptor, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    csv_reader *const reader = malloc(sizeof *reader);
    assert_non_null(reader);
    error->text[0] = '\0';
    float sum = 0.0f, row[2];
    *result = CSV_ERROR;
    if (csv_open(reader, path, "a,b", error)) {
        while ((*result = csv_read_row(reader, names, 2, row, error)) == CSV_ROW)
            sum += row[0] + 10.0f * row[1];
        csv_close(reader);
    }
    free(reader);
    remove(path);
    return sum;
}

static void tables_of_every_system_are_read(void **state) {
    (void)state;
    static const char *const tables[] = {
        "a,b\n1,2\n3,-4.5e0\n",
        "a,b\n1,2\n3,-4.5",
        "a, b\n1, 2\n 3 ,\t-4.5 \n",
        "a,b\r\n1,2\r\n3,-4.5\r\n\r\n",
        "\357\273\277a,b\n+1,2.\n3,-.45e+1\n\n\n",
    };
    for (size_t i = 0; i < sizeof tables / sizeof tables[0]; i++) {
        csv_result result;
        base_error error;
        const float sum = read_table(tables[i], strlen(tables[i]), &result, &error);
        if (result != CSV_END || sum != -21.0f)
            fail_msg("table %zu: %g, %s", i, (double)sum, error.text);
    }
}

static void wrong_tables_are_refused_with_their_line(void **state) {
    (void)state;
    static const char *const wrong[][2] = {
        { "", "is empty (its first line must be a,b)" },
        { "a,c\n1,2\n", "line 1: the header must be a,b" },
        { "a,b,\n1,2\n", "line 1: the header must be a,b" },
        { "a,b\n1,2\n1\n", "line 3: has 1 columns, not 2" },
        { "a,b\n1,2,3\n", "line 2: has 3 columns, not 2" },
        { "a,b\n1,2,\n", "line 2: has 3 columns, not 2" },
        { "a,b\n1,\n", "line 2: b: \"\" is not a number" },
        { "a,b\n1, \n", "line 2: b: \"\" is not a number" },
        { "a,b\n1 2,3\n", "line 2: a: \"1 2\" is not a number" },
        { "a b\n1,2\n", "line 1: the header must be a,b" },
        { "a,b\nnan,2\n", "line 2: a: \"nan\" is not a number" },
        { "a,b\n1,inf\n", "line 2: b: \"inf\" is not a number" },
        { "a,b\n1,0x10\n", "line 2: b: \"0x10\" is not a number" },
        { "a,b\n1,1e39\n", "line 2: b: 1e39 is out of range" },
        { "a,b\n1,1e999\n", "line 2: b: \"1e999\" is not a number" },
        { "a,b\n1,2\n\n3,4\n", "line 3: is empty" },
        { "a,b\n1\r,2\n", "line 2: a: \"1?\" is not a number" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        csv_result result;
        base_error error;
        read_table(wrong[i][0], strlen(wrong[i][0]), &result, &error);
        assert_int_equal(result, CSV_ERROR);
        if (!strstr(error.text, wrong[i][1]))
            fail_msg("%s: %s", wrong[i][0], error.text);
    }
    csv_result result;
    base_error error;
    read_table("a,b\n1\0,2\n", 9, &result, &error);
    assert_non_null(strstr(error.text, "line 2: a: "));
}

static void long_tables_pass_and_long_lines_do_not(void **state) {
    (void)state;
    const size_t size = 4 * CSV_LINE_MAX;
    char *const table = malloc(size);
    assert_non_null(table);
    memcpy(table, "a,b\n", 4);
    for (size_t i = 4; i < size; i += 4)
        memcpy(table + i, "1,0\n", 4);
    csv_result result;
    base_error error;
    assert_true(read_table(table, size, &result, &error) == (float)(size / 4 - 1));
    assert_int_equal(result, CSV_END);
    memset(table + 4, '1', size - 4);
    read_table(table, size, &result, &error);
    assert_non_null(strstr(error.text, "line 2: is longer than 65535 bytes"));
    free(table);
}

static void missing_and_unreadable_files_are_reported(void **state) {
    (void)state;
    csv_reader *const reader = malloc(sizeof *reader);
    assert_non_null(reader);
    base_error error;
    assert_false(csv_open(reader, "/nowhere/table.csv", "a,b", &error));
    assert_string_equal(error.text, "/nowhere/table.csv: No such file or directory");
    assert_false(csv_open(reader, "/", "a,b", &error));
    assert_string_equal(error.text, "/: cannot read: Is a directory");
    free(reader);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floats_are_printed_as_printf_does),
        cmocka_unit_test(zero_has_no_sign),
        cmocka_unit_test(tables_of_every_system_are_read),
        cmocka_unit_test(wrong_tables_are_refused_with_their_line),
        cmocka_unit_test(long_tables_pass_and_long_lines_do_not),
        cmocka_unit_test(missing_and_unreadable_files_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
