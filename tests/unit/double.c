/* SPDX-License-Identifier: MIT */
/* The functions in double, checked against the vector files and the oracle. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/light.h>

#include <math.h>

enum { BANDS = 20, COUNT = BANDS * BANDS };

static void random_direction(double w[3]) {
    const double z = check_random_between(-1, 1), azimuth = check_random_between(0, 2 * acos(-1));
    const double s = sqrt((1 - z) * (1 + z));
    w[0] = s * cos(azimuth), w[1] = s * sin(azimuth), w[2] = z;
}

static void evaluates_the_vector_file(void **state) {
    (void)state;
    check_csv *csv = check_csv_open("basis.csv");
    for (int row = 0; row < csv->rows; row++) {
        double w[3], expected[169], sh[169];
        check_csv_numbers(csv, row, 0, 3, w);
        check_csv_numbers(csv, row, 3, 169, expected);
        const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
        for (int i = 0; i < 3; i++)
            w[i] /= length;
        lmp_sh_eval_double(13, w, sh);
        CHECK_WITHIN(check_error_double(169, expected, sh), 3e-14);
    }
    check_csv_close(csv);
}

static void projects_the_vector_files(void **state) {
    (void)state;
    static const struct {
        const char *name;
        int bands;
    } files[] = { { "sphere.csv", 10 }, { "sphere_inside.csv", 6 } };
    for (int i = 0; i < 2; i++) {
        check_csv *csv = check_csv_open(files[i].name);
        const int count = files[i].bands * files[i].bands;
        for (int row = 0; row < csv->rows; row++) {
            double in[7], expected[100], sh[100];
            check_csv_numbers(csv, row, 0, 7, in);
            check_csv_numbers(csv, row, 7, count, expected);
            lmp_sphere_project_double(files[i].bands, in, in[3], in + 4, sh);
            CHECK_WITHIN(check_error_double((size_t)count, expected, sh), 3e-14);
        }
        check_csv_close(csv);
    }
}

static void agrees_with_the_oracle_at_any_number_of_bands(void **state) {
    (void)state;
    static const struct {
        int bands;
        double bound;
    } cases[] = { { 1, 1e-14 }, { 3, 1e-14 }, { BANDS, 3e-14 }, { LMP_BANDS_MAX, 1.5e-13 } };
    static double sh[LMP_BANDS_MAX * LMP_BANDS_MAX], expected[LMP_BANDS_MAX * LMP_BANDS_MAX];
    for (int i = 0; i < 4; i++) {
        const size_t count = LMP_SH_COUNT(cases[i].bands);
        for (int trial = 0; trial < 10; trial++) {
            double w[3], point[3] = { 0 };
            random_direction(w);
            lmp_sh_eval_double(cases[i].bands, w, sh);
            oracle_sh_eval(cases[i].bands, w, expected);
            CHECK_WITHIN(check_error_double(count, expected, sh), cases[i].bound);
            const double radius = check_random_between(0, 1);
            lmp_sphere_project_double(cases[i].bands, w, radius, point, sh);
            oracle_sphere(cases[i].bands, w, radius, point, expected, NULL);
            CHECK_WITHIN(check_error_double(count, expected, sh), cases[i].bound);
        }
    }
}

/* Central differences of degree 4 apply to a polynomial of degree below 20, so only rounding
 * remains. */
static void gradients_are_those_of_differences(void **state) {
    (void)state;
    for (int trial = 0; trial < 20; trial++) {
        double w[3], sh[COUNT], gradient[3 * COUNT];
        random_direction(w);
        lmp_sh_eval_gradient_double(BANDS, w, sh, gradient);
        for (int axis = 0; axis < 3; axis++) {
            static const double step = 1e-3, weights[4] = { 1, -8, 8, -1 };
            static const int at[4] = { -2, -1, 1, 2 };
            double expected[COUNT] = { 0 };
            for (int k = 0; k < 4; k++) {
                double moved[3] = { w[0], w[1], w[2] }, there[COUNT];
                moved[axis] += at[k] * step;
                const double length = hypot(hypot(moved[0], moved[1]), moved[2]);
                for (int i = 0; i < 3; i++)
                    moved[i] /= length;
                lmp_sh_eval_double(BANDS, moved, there);
                for (int i = 0; i < COUNT; i++)
                    expected[i] += weights[k] * there[i] / (12 * step);
            }
            CHECK_WITHIN(check_error_double(COUNT, expected, gradient + axis * COUNT), 1e-6);
        }
    }
}

static void second_derivatives_are_those_of_the_gradient(void **state) {
    (void)state;
    static const int plane_of[3][3] = { { 0, 1, 2 }, { 1, 3, 4 }, { 2, 4, 5 } };
    static double hessian[6 * COUNT], ahead[3 * COUNT], behind[3 * COUNT];
    for (int trial = 0; trial < 20; trial++) {
        const double step = 1e-5;
        double w[3], sh[COUNT], trace[COUNT];
        random_direction(w);
        lmp_sh_eval_hessian_double(BANDS, w, hessian);
        lmp_sh_eval_double(BANDS, w, sh);
        for (int l = 0; l < BANDS; l++)
            for (int i = l * l; i < (l + 1) * (l + 1); i++) {
                sh[i] *= -l * (l + 1);
                trace[i] = hessian[i] + hessian[3 * COUNT + i] + hessian[5 * COUNT + i];
            }
        CHECK_WITHIN(check_error_double(COUNT, sh, trace), 1e-12);
        /* Along the direction the function does not change, and its gradient falls as 1 / |v|. */
        for (int axis = 0; axis < 3; axis++) {
            double expected[3 * COUNT];
            for (int side = -1; side <= 1; side += 2) {
                double v[3] = { w[0], w[1], w[2] };
                v[axis] += side * step;
                const double length = hypot(hypot(v[0], v[1]), v[2]);
                for (int i = 0; i < 3; i++)
                    v[i] /= length;
                double *gradient = side < 0 ? behind : ahead;
                lmp_sh_eval_gradient_double(BANDS, v, sh, gradient);
                for (int i = 0; i < 3 * COUNT; i++)
                    gradient[i] /= length;
            }
            for (int i = 0; i < 3 * COUNT; i++)
                expected[i] = (ahead[i] - behind[i]) / (2 * step);
            for (int other = 0; other < 3; other++)
                CHECK_WITHIN(check_error_double(COUNT, expected + other * COUNT,
                                                hessian + plane_of[axis][other] * COUNT),
                             1e-6);
        }
    }
}

/* The derivatives of one column come with the columns after it, which few bands do not have. */
static void few_bands_are_the_first_of_many(void **state) {
    (void)state;
    static double many[6 * COUNT], few[6 * COUNT];
    for (int bands = 1; bands < BANDS; bands++) {
        const size_t count = (size_t)bands * (size_t)bands;
        double w[3];
        random_direction(w);
        lmp_sh_eval_hessian_double(BANDS, w, many);
        lmp_sh_eval_hessian_double(bands, w, few);
        for (size_t plane = 0; plane < 6; plane++)
            for (size_t i = 0; i < count; i++)
                CHECK_WITHIN(fabs(few[plane * count + i] - many[plane * COUNT + i]), 1e-12);
    }
}

static void rotated_coefficients_are_those_of_the_rotated_direction(void **state) {
    (void)state;
    static double matrices[LMP_SH_ROTATION_COUNT(BANDS)];
    for (int trial = 0; trial < 20; trial++) {
        const lmp_quat q = check_random_rotation();
        const double quat[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
        double r[9], w[3], there[3], sh[COUNT], rotated[COUNT], expected[COUNT], length = 0;
        for (int i = 0; i < 4; i++)
            length += quat[i] * quat[i];
        const double unit[4] = { quat[0] / sqrt(length), quat[1] / sqrt(length),
                                 quat[2] / sqrt(length), quat[3] / sqrt(length) };
        oracle_quaternion_matrix(unit, r);
        random_direction(w);
        for (int i = 0; i < 3; i++)
            there[i] = r[3 * i] * w[0] + r[3 * i + 1] * w[1] + r[3 * i + 2] * w[2];
        lmp_sh_make_rotation_double(BANDS, quat, matrices);
        lmp_sh_eval_double(BANDS, w, sh);
        lmp_sh_rotate_double(BANDS, matrices, sh, rotated);
        lmp_sh_eval_double(BANDS, there, expected);
        CHECK_WITHIN(check_error_double(COUNT, expected, rotated), 1e-13);
    }
}

/* One buffer holds all results, separate but adjacent. */
static void results_may_lie_side_by_side(void **state) {
    (void)state;
    double w[3], sh[COUNT], gradient[3 * COUNT], both[4 * COUNT];
    random_direction(w);
    lmp_sh_eval_gradient_double(BANDS, w, sh, gradient);
    lmp_sh_eval_gradient_double(BANDS, w, both, both + COUNT);
    assert_memory_equal(both, sh, sizeof sh);
    assert_memory_equal(both + COUNT, gradient, sizeof gradient);
    lmp_sh_eval_gradient_double(BANDS, w, both + 3 * (size_t)COUNT, both);
    assert_memory_equal(both, gradient, sizeof gradient);
    assert_memory_equal(both + 3 * (size_t)COUNT, sh, sizeof sh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(evaluates_the_vector_file),
        cmocka_unit_test(projects_the_vector_files),
        cmocka_unit_test(agrees_with_the_oracle_at_any_number_of_bands),
        cmocka_unit_test(gradients_are_those_of_differences),
        cmocka_unit_test(second_derivatives_are_those_of_the_gradient),
        cmocka_unit_test(few_bands_are_the_first_of_many),
        cmocka_unit_test(rotated_coefficients_are_those_of_the_rotated_direction),
        cmocka_unit_test(results_may_lie_side_by_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
