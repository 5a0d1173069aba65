/* SPDX-License-Identifier: MIT */
/* Ambient light: closed forms, and the library's sums of the same image truncated to bands. */
#include "app/truth/reference_estimate.h"
#include "tests/oracle/check.h"

#include <lampion/shade.h>

#include <math.h>

enum { WIDTH = 16, HEIGHT = 8 };

static environment around(float even) {
    environment e = { .azimuth = 0.7f };
    base_error error;
    assert_true(image_create(&e.light, WIDTH, HEIGHT, &error));
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        e.light.rgb[i] = even > 0 ? even : powf((float)check_random(), 8) * 20;
    return e;
}

static reference_result estimate(const environment *e, const reference_surface *surface) {
    const reference_stop stop = { .samples = 20000 };
    reference_environment own;
    reference_estimator estimator;
    assert_true(reference_environment_create(e, &own));
    assert_true(reference_estimator_create(&estimator, NULL, 0));
    estimator.environment = &own;
    const reference_result result = reference_estimate(&estimator, surface, &stop, 11);
    reference_estimator_free(&estimator);
    reference_environment_free(&own);
    return result;
}

static const reference_material painted = { .diffuse = { 0.5, 0.25, 0.125 },
                                            .specular = { 0.25, 0.5, 0.75 },
                                            .exponent = 12 };

static void an_even_light_is_reflected_by_the_albedo(void **state) {
    (void)state;
    environment e = around(2);
    const reference_band_limit whole = { .bands = 0 };
    for (int i = 0; i < 20; i++) {
        reference_surface surface;
        const lmp_vec3 n = check_random_direction(), v = check_random_direction();
        reference_surface_set(&surface, &whole, &painted, (reference_vec) { 0, 0, 0 },
                              reference_from(n), reference_from(v));
        const reference_result result = estimate(&e, &surface);
        for (int c = 0; c < 3; c++)
            CHECK_WITHIN(fabs(result.mean[c] - 2 * (painted.diffuse[c] + painted.specular[c])),
                         5 * result.standard_error[c] + 1e-6);
    }
    environment_free(&e);
}

/* Lobes truncated to bands depend only on the image's coefficients. */
static void truncated_lobes_agree_with_the_library(void **state) {
    (void)state;
    environment e = around(0);
    base_error error;
    const reference_band_limit limit = { .bands = 6, .window = LMP_WINDOW_HANNING };
    const lmp_material material = { .diffuse = { 0.5f, 0.25f, 0.125f },
                                    .specular = { 0.25f, 0.5f, 0.75f },
                                    .exponent = 12 };
    const lmp_shade_settings settings = { .method = LMP_SHADE_COEFFICIENTS,
                                          .bands = 6,
                                          .window = LMP_WINDOW_HANNING };
    assert_true(environment_project(&e, 6, &error));
    const lmp_environment light = { e.sh, e.bands };
    for (int i = 0; i < 20; i++) {
        reference_surface surface;
        const lmp_surface same = { .normal = check_random_direction(),
                                   .view = check_random_direction() };
        reference_surface_set(&surface, &limit, &painted, (reference_vec) { 0, 0, 0 },
                              reference_from(same.normal), reference_from(same.view));
        const reference_result result = estimate(&e, &surface);
        const lmp_rgb color = lmp_shade_environment(&settings, &material, &same, &light);
        for (int c = 0; c < 3; c++) {
            const double value = (double)(&color.r)[c];
            /* Coefficients take pixels at their centers, which differs by some thousandths. */
            CHECK_WITHIN(fabs(result.mean[c] - value), 5 * result.standard_error[c] + 0.02 * value);
        }
    }
    environment_free(&e);
}

/* Directions are drawn as often as their density says: the mean of its reciprocal is the whole
 * sphere. */
static void directions_are_drawn_by_their_density(void **state) {
    (void)state;
    environment e = around(0);
    reference_environment own;
    double solid_angle = 0, power[3] = { 0 };
    enum { COUNT = 200000 };
    assert_true(reference_environment_create(&e, &own));
    for (int i = 0; i < COUNT; i++) {
        double radiance[3] = { 0 };
        const reference_vec w = reference_environment_draw(&own, check_random(), check_random());
        CHECK_WITHIN(fabs(reference_length(w) - 1), 1e-12);
        const double density = reference_environment_at(&own, w, radiance);
        assert_true(density > 0);
        solid_angle += 1 / density / COUNT;
        for (int c = 0; c < 3; c++)
            power[c] += radiance[c] / density / COUNT;
    }
    CHECK_WITHIN(fabs(solid_angle / (4 * M_PI) - 1), 0.1);
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabs(power[c] / (4 * M_PI * own.mean[c]) - 1), 0.02);
    reference_environment_free(&own);
    environment_free(&e);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_even_light_is_reflected_by_the_albedo),
        cmocka_unit_test(truncated_lobes_agree_with_the_library),
        cmocka_unit_test(directions_are_drawn_by_their_density),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
