/* SPDX-License-Identifier: MIT */
/* The calls for one element have the same bits on every instruction set and, for few bands, the
 * values of double precision. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/cpu.h>
#include <lampion/light.h>
#include <lampion/sh.h>

#include <math.h>
#include <string.h>

enum { BANDS = 8, COUNT = BANDS * BANDS, RESULTS = 11 * COUNT };

static const unsigned sets[] = { LMP_CPU_SCALAR, LMP_CPU_VECTOR, LMP_CPU_AVX2, LMP_CPU_AVX512 };

typedef struct inputs {
    lmp_vec3 direction;
    float rotation[9], a[COUNT], b[COUNT];
    lmp_light light;
} inputs;

static inputs random_inputs(int trial) {
    inputs in = { .direction = check_random_direction() };
    const lmp_quat q = trial == 0 ? (lmp_quat) { 0, 0, 0, 1 } : check_random_rotation();
    const double four[4] = { (double)q.x, (double)q.y, (double)q.z, (double)q.w };
    double rotation[9];
    oracle_quaternion_matrix(four, rotation);
    for (int k = 0; k < 9; k++)
        in.rotation[k] = (float)rotation[k];
    for (int k = 0; k < COUNT; k++) {
        /* with zeros of both signs */
        in.a[k] = (k + trial) % 5 == 0 ? (k % 2 ? 0.f : -0.f) : (float)check_random_between(-1, 1);
        in.b[k] = (float)check_random_between(-1, 1);
    }
    in.light = (lmp_light) { .kind = (lmp_light_kind)(trial % 4),
                             .position = check_random_direction(),
                             .direction = check_random_direction(),
                             .radius = (float)check_random_between(0.1, 1.5),
                             .radiance = { 3, 2, 1 } };
    return in;
}

static void call_all(int bands, const inputs *in, float results[RESULTS]) {
    const lmp_vec3 origin = { 0, 0, 0 };
    memset(results, 0, RESULTS * sizeof *results);
    lmp_sh_eval(bands, in->direction, results);
    lmp_sh_combine(bands, 0.3f, in->a, -2, in->b, results + COUNT);
    lmp_sh_rotate_by_matrix(bands, in->rotation, in->a, results + 2 * COUNT);
    lmp_light_project(bands, &in->light, 1, origin, results + 3 * COUNT);
    lmp_sh_rotate_z(bands, 3 * in->b[0], in->a, results + 6 * COUNT);
    lmp_sphere_project(bands, in->light.position, in->light.radius, origin, results + 7 * COUNT);
    if (bands <= LMP_SH_FEW_BANDS)
        lmp_sh_multiply_few(bands, in->a, in->b, results + 8 * COUNT);
    results[RESULTS - 1] = lmp_sh_dot(bands, in->a, in->b);
}

static void every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        const inputs in = random_inputs(trial);
        for (int bands = 1; bands < BANDS; bands++) {
            float expected[RESULTS], results[RESULTS];
            lmp_cpu_limit(LMP_CPU_SCALAR);
            call_all(bands, &in, expected);
            for (size_t k = 1; k < sizeof sets / sizeof *sets; k++) {
                lmp_cpu_limit(sets[k]);
                call_all(bands, &in, results);
                assert_memory_equal(expected, results, sizeof results);
            }
        }
    }
    lmp_cpu_limit(LMP_CPU_ALL);
}

static void one_light_is_what_two_are_of_half_its_light(void **state) {
    (void)state;
    for (int trial = 0; trial < 60; trial++) {
        const inputs in = random_inputs(trial);
        for (int bands = 1; bands < BANDS; bands++) {
            const size_t count = 3 * LMP_SH_COUNT(bands);
            lmp_light half[2] = { in.light, in.light };
            float one[3 * COUNT], two[3 * COUNT];
            double expected[3 * COUNT];
            for (int i = 0; i < 2; i++)
                half[i].radiance = (lmp_rgb) { 1.5f, 1, 0.5f };
            lmp_light_project(bands, &in.light, 1, (lmp_vec3) { 0, 0, 0 }, one);
            lmp_light_project(bands, half, 2, (lmp_vec3) { 0, 0, 0 }, two);
            for (size_t k = 0; k < count; k++)
                expected[k] = (double)two[k];
            CHECK_WITHIN(check_error(count, expected, one), 3e-7);
        }
    }
}

static void dots_and_sums_are_those_of_double(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        const inputs in = random_inputs(trial);
        for (int bands = 1; bands < BANDS; bands++) {
            float sum[COUNT];
            double dot = 0, size = 0;
            lmp_sh_combine(bands, 0.3f, in.a, -2, in.b, sum);
            for (size_t k = 0; k < LMP_SH_COUNT(bands); k++) {
                const double a = (double)in.a[k], b = (double)in.b[k];
                CHECK_WITHIN(fabs((double)sum[k] - ((double)0.3f * a - 2 * b)), 3e-7);
                dot += a * b;
                size += fabs(a * b);
            }
            CHECK_WITHIN(fabs((double)lmp_sh_dot(bands, in.a, in.b) - dot), 4e-7 * size);
        }
    }
}

static void products_commute_and_know_one(void **state) {
    (void)state;
    for (int trial = 0; trial < 200; trial++) {
        const inputs in = random_inputs(trial);
        for (int bands = 1; bands <= LMP_SH_FEW_BANDS; bands++) {
            const float one[COUNT] = { 3.54490770f }; /* sqrt(4 pi) */
            float ab[COUNT], ba[COUNT], same[COUNT];
            double expected[COUNT];
            lmp_sh_multiply_few(bands, in.a, in.b, ab);
            lmp_sh_multiply_few(bands, in.b, in.a, ba);
            lmp_sh_multiply_few(bands, one, in.b, same);
            assert_memory_equal(ab, ba, LMP_SH_COUNT(bands) * sizeof *ab);
            for (size_t k = 0; k < LMP_SH_COUNT(bands); k++)
                expected[k] = (double)in.b[k];
            CHECK_WITHIN(check_error(LMP_SH_COUNT(bands), expected, same), 1e-6);
        }
    }
}

static void rotates_around_z_by_any_angle(void **state) {
    (void)state;
    for (int trial = 0; trial < 2000; trial++) {
        const float angle = (float)(check_random_between(-1, 1) * pow(10, trial % 9));
        const float x[4] = { 0, 0, 0, 1 };
        float rotated[4];
        lmp_sh_rotate_z(2, angle, x, rotated);
        CHECK_WITHIN(fabs((double)rotated[1] - sin((double)angle)), 1e-7);
        CHECK_WITHIN(fabs((double)rotated[3] - cos((double)angle)), 1e-7);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(one_light_is_what_two_are_of_half_its_light),
        cmocka_unit_test(dots_and_sums_are_those_of_double),
        cmocka_unit_test(products_commute_and_know_one),
        cmocka_unit_test(rotates_around_z_by_any_angle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
