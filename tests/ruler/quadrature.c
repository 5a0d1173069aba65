/* SPDX-License-Identifier: MIT */
/* Proven values against dense plain sums around the light, of the formula written with vectors. */
#include "tests/ruler/formula.h"

#define STEPS 500

/* Whether a row is smooth enough for such a sum: its lobe is not narrow beside its light. */
static bool is_smooth(const ruler_row *row) {
    const double half_angle = ruler_half_angle(row);
    return half_angle > 0 && row->exponent <= 100 &&
           (row->material < RULER_METAL || row->roughness >= 0.4 || half_angle < 10) &&
           row->value > 0.01 * ruler_scale(row);
}

/* Ten of the rows, others at each seed, with as many of one material as of another. */
static void ten_rows_agree_with_a_dense_sum(void **state) {
    (void)state;
    ruler_table table = open_table();
    double worst = 0;
    for (int count = 0, tries = 0; count < check_count(10, 60); tries++) {
        const ruler_row *const row = &table.rows[(int)(check_random() * table.count)];
        assert_true(tries < 100000);
        if ((int)row->material != count % RULER_MATERIALS || !is_smooth(row))
            continue;
        const double sum = formula_over_light(row, DIAGNOSIS_NONE, STEPS);
        const double error = fabs(sum - row->value) / row->value;
        worst = fmax(worst, error);
        CHECK_WITHIN(error, 1e-3);
        count++;
    }
    print_message("the largest difference is %.2g of a value\n", worst);
    ruler_table_free(&table);
}

/* One direction needs no sum. */
static void single_directions_are_the_formula(void **state) {
    (void)state;
    ruler_table table = open_table();
    int count = 0;
    for (int i = 0; i < table.count; i++) {
        const ruler_row *const row = &table.rows[i];
        if (ruler_half_angle(row) > 0)
            continue;
        const double exact = formula_over_light(row, DIAGNOSIS_NONE, 1);
        CHECK_WITHIN(fabs(exact - row->value), 1e-9 * row->value + row->radius + 1e-14);
        count++;
    }
    assert_true(count > 100);
    ruler_table_free(&table);
}

/* Spheres have a closed form: one above the horizon reflects (r/d)² times the cosine of its
 * direction. */
static void diffuse_spheres_have_a_closed_form(void **state) {
    (void)state;
    ruler_table table = open_table();
    int count = 0;
    for (int i = 0; i < table.count; i++) {
        const ruler_row *const row = &table.rows[i];
        if (row->material != RULER_LAMBERT || row->light != RULER_SPHERE || row->size >= 1 ||
            row->light_angle + ruler_half_angle(row) > 90)
            continue;
        const double exact = row->size * row->size * cos(row->light_angle * RADIANS);
        CHECK_WITHIN(fabs(exact - row->value), 2e-11 * exact);
        count++;
    }
    assert_true(count > 30);
    ruler_table_free(&table);
}

/* Radii are as small as the document promises. */
static void radii_are_as_small_as_promised(void **state) {
    (void)state;
    ruler_table table = open_table();
    for (int i = 0; i < table.count; i++) {
        const ruler_row *const row = &table.rows[i];
        const double relative = row->material < RULER_METAL ? 1e-10 : 1e-7;
        CHECK_WITHIN(row->radius, relative * fmax(row->value, 1e-6 * ruler_scale(row)));
    }
    ruler_table_free(&table);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ten_rows_agree_with_a_dense_sum),
        cmocka_unit_test(single_directions_are_the_formula),
        cmocka_unit_test(diffuse_spheres_have_a_closed_form),
        cmocka_unit_test(radii_are_as_small_as_promised),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
