/* SPDX-License-Identifier: MIT */
/* Columns of values with an error of each kind: `lampion ruler --check` refuses them and names the
 * likely cause. A column is the truth plus the difference that the error makes in a plain sum.
 */
#include "tests/program/folder.h"
#include "tests/ruler/formula.h"

#define STEPS 32

static double with_error(const ruler_row *row, diagnosis kind) {
    if (kind == DIAGNOSIS_NORMALIZATION)
        return acos(-1) * row->value;
    return row->value + formula_over_light(row, kind, STEPS) -
           formula_over_light(row, DIAGNOSIS_NONE, STEPS);
}

static void write_column(diagnosis kind) {
    ruler_table table = open_table();
    FILE *const file = fopen(in_folder("column.csv"), "w");
    assert_non_null(file);
    fprintf(file, "id,value\n");
    for (int i = 0; i < table.count; i++)
        fprintf(file, "%d,%.9g\n", table.rows[i].id,
                kind == DIAGNOSIS_NONE ? table.rows[i].value : with_error(&table.rows[i], kind));
    assert_int_equal(fclose(file), 0);
    ruler_table_free(&table);
}

/* Expects the check of such a column to print a text, with status 0 only without an error. */
static void expect(diagnosis kind, const char *text) {
    char command[1024], printed[16384];
    write_column(kind);
    snprintf(command, sizeof command, "%s ruler --check %s", getenv("LAMPION_PROGRAM"),
             in_folder("column.csv"));
    FILE *const program = popen(command, "r");
    assert_non_null(program);
    printed[fread(printed, 1, sizeof printed - 1, program)] = '\0';
    const int status = pclose(program);
    if (!strstr(printed, text) || (status != 0) != (kind != DIAGNOSIS_NONE))
        fail_msg("status %d, no \"%s\" in:\n%s", status, text, printed);
}

static void the_truth_is_within_the_limits(void **state) {
    (void)state;
    expect(DIAGNOSIS_NONE, "verdict: within the limits");
}
static void phong_for_ggx_is_named(void **state) {
    (void)state;
    expect(DIAGNOSIS_PHONG, "it looks like another distribution");
}
static void a_missing_horizon_clip_is_named(void **state) {
    (void)state;
    expect(DIAGNOSIS_HORIZON, "it looks like a missing horizon clip");
}
static void a_missing_fresnel_term_is_named(void **state) {
    (void)state;
    expect(DIAGNOSIS_FRESNEL, "it looks like a missing or other Fresnel term");
}
static void a_wrong_normalization_is_named(void **state) {
    (void)state;
    expect(DIAGNOSIS_NORMALIZATION, "every value of lambert is 3.142 times the truth");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_truth_is_within_the_limits),
        cmocka_unit_test(phong_for_ggx_is_named),
        cmocka_unit_test(a_missing_horizon_clip_is_named),
        cmocka_unit_test(a_missing_fresnel_term_is_named),
        cmocka_unit_test(a_wrong_normalization_is_named),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
