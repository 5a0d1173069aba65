/* SPDX-License-Identifier: MIT */
/* Probes as game engines keep them, evaluated as those engines' shaders do. */
#include "tests/oracle/check.h"
#include "tests/oracle/engines.h"

#include <lampion/light.h>

#include <string.h>

enum { SPHERES = 200 };

/* A sphere around a random point, its probe of `bands` bands, and a normal. */
typedef struct seen_sphere {
    lmp_light light;
    double distance, cosine, normal[3];
    float sh[3 * 25];
} seen_sphere;

static seen_sphere random_sphere(int bands) {
    const lmp_vec3 direction = check_random_direction(), n = check_random_direction();
    const lmp_vec3 point = { 1, -2, 0.5f };
    const float distance = (float)check_random_between(1, 5);
    seen_sphere seen = {
        .light = { .position = { point.x + distance * direction.x, point.y + distance * direction.y,
                                 point.z + distance * direction.z },
                   .radius = distance * (float)check_random_between(0.01, 0.95),
                   .radiance = { 3, 0.5f, 7 } },
        .distance = (double)distance,
        .cosine = (double)(direction.x * n.x + direction.y * n.y + direction.z * n.z),
        .normal = { (double)n.x, (double)n.y, (double)n.z },
    };
    lmp_light_project(bands, &seen.light, 1, point, seen.sh);
    return seen;
}

static double radiance(const lmp_light *light, int c) {
    return (double)(&light->radiance.r)[c];
}

static void shaders_of_engines_find_the_irradiance_of_three_bands(void **state) {
    (void)state;
    for (int k = 0; k < SPHERES; k++) {
        const int bands = 3 + k % 3;
        const seen_sphere seen = random_sphere(bands);
        const double r = (double)seen.light.radius, d = seen.distance;
        for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++) {
            float values[27];
            lmp_probe_export(bands, lmp_probe_engine_format((lmp_probe_engine)e), seen.sh, values);
            for (int c = 0; c < 3; c++) {
                const double factor = radiance(&seen.light, c) / ORACLE_PI;
                const double peak = factor * sphere_irradiance(r, d, 1);
                const double expected = factor * sphere_irradiance_of_3_bands(r, d, seen.cosine);
                const double found = engine_reflects((lmp_probe_engine)e, values, c, seen.normal);
                CHECK_WITHIN(fabs(found - expected), 2e-5 * peak);
            }
        }
    }
}

/* Three bands are within 7 % of the peak of a light, however small, and within 1 % of one that
 * fills half of what is seen. */
static void three_bands_are_near_the_exact_irradiance(void **state) {
    (void)state;
    int judged = 0;
    for (int k = 0; k < 4 * SPHERES; k++) {
        const seen_sphere seen = random_sphere(3);
        const double r = (double)seen.light.radius, d = seen.distance;
        const double exact = sphere_irradiance(r, d, seen.cosine) / ORACLE_PI;
        const double peak = sphere_irradiance(r, d, 1) / ORACLE_PI;
        if (!(seen.cosine > r / d))
            continue;
        for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++) {
            float values[27];
            lmp_probe_export(3, lmp_probe_engine_format((lmp_probe_engine)e), seen.sh, values);
            const double found = engine_reflects((lmp_probe_engine)e, values, 0, seen.normal);
            CHECK_WITHIN(fabs(found / radiance(&seen.light, 0) - exact), 0.1 * peak);
        }
        judged++;
    }
    assert_true(judged > SPHERES);
}

static void formats_can_be_changed(void **state) {
    (void)state;
    const seen_sphere seen = random_sphere(3);
    lmp_probe_format format = *lmp_probe_engine_format(LMP_PROBE_FILAMENT);
    float values[27], mirrored[27];
    lmp_probe_export(3, &format, seen.sh, values);
    memcpy(format.convention.axes, (signed char[]) { -1, 2, 3 }, 3);
    lmp_probe_export(3, &format, seen.sh, mirrored);
    const double across[3] = { -seen.normal[0], seen.normal[1], seen.normal[2] };
    CHECK_WITHIN(fabs(engine_reflects(LMP_PROBE_FILAMENT, values, 1, seen.normal) -
                      engine_reflects(LMP_PROBE_FILAMENT, mirrored, 1, across)),
                 1e-5);
}

/* What is written may be adjacent to what is read. */
static void values_may_lie_beside_coefficients(void **state) {
    (void)state;
    const seen_sphere seen = random_sphere(3);
    float values[27], row[3 * 27];
    memcpy(row + 27, seen.sh, sizeof values);
    for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++) {
        const lmp_probe_format *format = lmp_probe_engine_format((lmp_probe_engine)e);
        lmp_probe_export(3, format, seen.sh, values);
        lmp_probe_export(3, format, row + 27, row);
        lmp_probe_export(3, format, row + 27, row + 2 * 27);
        assert_memory_equal(row, values, sizeof values);
        assert_memory_equal(row + 2 * 27, values, sizeof values);
    }
}

static void formats_have_names_and_units(void **state) {
    (void)state;
    static const char *const names[LMP_PROBE_ENGINE_COUNT] = { "unity", "unreal", "godot",
                                                               "filament" };
    for (int e = 0; e < LMP_PROBE_ENGINE_COUNT; e++) {
        const lmp_probe_format *format = lmp_probe_engine_format((lmp_probe_engine)e);
        assert_string_equal(format->name, names[e]);
        assert_true(format->unit == (e == LMP_PROBE_UNREAL ? 100 : 1));
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shaders_of_engines_find_the_irradiance_of_three_bands),
        cmocka_unit_test(three_bands_are_near_the_exact_irradiance),
        cmocka_unit_test(formats_can_be_changed),
        cmocka_unit_test(values_may_lie_beside_coefficients),
        cmocka_unit_test(formats_have_names_and_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
