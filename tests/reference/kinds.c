/* SPDX-License-Identifier: MIT */
/* Lights of every kind against closed forms of what a white diffuse surface reflects. */
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_quadrature.h"
#include "tests/oracle/check.h"

#include <string.h>

static const reference_vec origin = { 0, 0, 0 };

/* Returns a surface whose normal lies at `tilt` from y towards x. */
static reference_surface white_surface(double tilt) {
    const reference_band_limit whole = { .bands = 0 };
    const reference_material white = { .diffuse = { 1, 1, 1 } };
    const reference_vec normal = { sin(tilt), cos(tilt), 0 };
    reference_surface surface;
    reference_surface_set(&surface, &whole, &white, origin, normal, normal);
    return surface;
}

static reference_result estimate(const reference_surface *surface, const lmp_light *light,
                                 reference_visibility visibility) {
    const scene_light own = { .emitter = *light };
    const reference_stop stop = { .samples = 4096 };
    reference_estimator estimator;
    assert_true(reference_estimator_create(&estimator, &own, 1));
    estimator.visibility = visibility;
    const reference_result result = reference_estimate(&estimator, surface, &stop, 3);
    reference_estimator_free(&estimator);
    return result;
}

/* Checks the radiance reflected for radiance, intensity or irradiance (1, 2, 4), by both
 * integrators. */
static void check(const lmp_light *light, double tilt, double truth) {
    const reference_surface surface = white_surface(tilt);
    const scene_light own = { .emitter = *light };
    const reference_result result = estimate(&surface, light, NULL);
    double exact[3];
    reference_quadrature(&surface, &own, 1, exact);
    for (int c = 0; c < 3; c++) {
        const double expected = truth * (1 << c);
        CHECK_WITHIN(fabs(exact[c] - expected), 1e-6 * expected);
        CHECK_WITHIN(fabs(result.mean[c] - expected),
                     4 * result.standard_error[c] + 1e-6 * expected);
    }
}

static const lmp_rgb color = { 1, 2, 4 };

static void a_point_light_falls_off_by_the_square_of_its_distance(void **state) {
    (void)state;
    const lmp_light light = { .kind = LMP_LIGHT_POINT,
                              .position = { 0, 2, 0 },
                              .intensity = color };
    check(&light, 0, 1 / (4 * REFERENCE_PI));
    check(&light, 1, cos(1) / (4 * REFERENCE_PI));
}

/* The points lie straight under the spot, on its rim, outside, and where the cosine is half way: a
 * quarter. */
static void a_spot_fades_between_its_cones(void **state) {
    (void)state;
    const double inner = 0.3, outer = 0.8, middle = acos((cos(0.3) + cos(0.8)) / 2);
    const double angles[] = { 0, 0.29, middle, 0.81, 3 }, falloff[] = { 1, 1, 0.25, 0, 0 };
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        const lmp_light light = { .kind = LMP_LIGHT_SPOT,
                                  .position = { 0, 3, 0 },
                                  .direction = { (float)sin(angles[i]), -(float)cos(angles[i]), 0 },
                                  .inner = (float)inner,
                                  .outer = (float)outer,
                                  .intensity = color };
        check(&light, 0, falloff[i] / (9 * REFERENCE_PI));
    }
}

static void a_directional_light_gives_its_irradiance_times_the_cosine(void **state) {
    (void)state;
    const lmp_light light = { .kind = LMP_LIGHT_DIRECTIONAL,
                              .direction = { 0, 1, 0 },
                              .irradiance = color };
    check(&light, 0, 1 / REFERENCE_PI);
    check(&light, 1, cos(1) / REFERENCE_PI);
    check(&light, 2, 0);
}

/* E = pi L sin²a cos(theta) above the horizon; a cap beyond pi/2, straight above, gives pi L. */
static void a_cap_gives_the_irradiance_of_a_sphere_as_wide(void **state) {
    (void)state;
    lmp_light light = { .kind = LMP_LIGHT_CAP, .direction = { 0, 1, 0 }, .radiance = color };
    const double angles[] = { 0.0047, 0.4, 1.2, 2, 3.1 };
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        light.angle = (float)angles[i];
        const double sine = angles[i] < 1.5 ? sin((double)light.angle) : 1;
        check(&light, 0, sine * sine);
        if (angles[i] < 0.5)
            check(&light, 1, sine * sine * cos(1));
    }
}

/* The sky fills (1 + cos)/2 of what a tilted surface sees, weighted by the cosine. */
static void a_tilted_surface_sees_sky_and_ground(void **state) {
    (void)state;
    for (double tilt = 0; tilt <= 3.2; tilt += 0.4) {
        const lmp_light sky = { .kind = LMP_LIGHT_HEMISPHERE,
                                .direction = { 0, 1, 0 },
                                .radiance = color };
        lmp_light both = sky;
        both.ground = (lmp_rgb) { 3, 6, 12 };
        check(&sky, tilt, (1 + cos(tilt)) / 2);
        check(&both, tilt, (1 + cos(tilt)) / 2 + 3 * (1 - cos(tilt)) / 2);
    }
}

/* A lobe of exponent 0 is 1/(2 pi) over the hemisphere around the mirror direction. Of a sky it
 * sees the fraction that their hemispheres share, 1 - t/pi; of a cap inside it the solid angle over
 * 2 pi. */
static void a_lobe_of_exponent_0_is_flat(void **state) {
    (void)state;
    const reference_band_limit whole = { .bands = 0 };
    const reference_material flat = { .specular = { 1, 1, 1 }, .exponent = 0 };
    const scene_light sky = { .emitter = { .kind = LMP_LIGHT_HEMISPHERE,
                                           .direction = { 0, 1, 0 },
                                           .radiance = { 1, 1, 1 } } };
    const scene_light sun = { .emitter = { .kind = LMP_LIGHT_CAP,
                                           .direction = { 0, 1, 0 },
                                           .angle = 0.25f,
                                           .radiance = { 1, 1, 1 } } };
    for (double tilt = 0; tilt < 3; tilt += 0.4) {
        const reference_vec normal = { sin(tilt), cos(tilt), 0 };
        reference_surface surface;
        double of_sky[3], of_sun[3];
        reference_surface_set(&surface, &whole, &flat, origin, normal, normal);
        reference_quadrature(&surface, &sky, 1, of_sky);
        reference_quadrature(&surface, &sun, 1, of_sun);
        CHECK_WITHIN(fabs(of_sky[0] - (1 - tilt / REFERENCE_PI)), 1e-6);
        const reference_result sampled = estimate(&surface, &sky.emitter, NULL);
        CHECK_WITHIN(fabs(sampled.mean[0] - of_sky[0]), 4 * sampled.standard_error[0] + 1e-6);
        if (tilt < REFERENCE_PI / 2 - 0.25)
            CHECK_WITHIN(fabs(of_sun[0] - (1 - cos(0.25))), 1e-6);
        if (tilt > REFERENCE_PI / 2 + 0.25)
            CHECK_WITHIN(of_sun[0], 1e-12);
    }
}

static double wall_at_one(reference_vec point, reference_vec direction, void *user) {
    (void)point;
    (void)direction;
    (void)user;
    return 1;
}

static void walls_hide_what_is_behind_them_and_nothing_before(void **state) {
    (void)state;
    const reference_surface surface = white_surface(0);
    const lmp_light lights[] = {
        { .kind = LMP_LIGHT_POINT, .position = { 0, 0.9f, 0 }, .intensity = color },
        { .kind = LMP_LIGHT_POINT, .position = { 0, 1.1f, 0 }, .intensity = color },
        { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0, 1, 0 }, .irradiance = color },
        { .kind = LMP_LIGHT_CAP, .direction = { 0, 1, 0 }, .angle = 0.5f, .radiance = color },
        { .kind = LMP_LIGHT_HEMISPHERE, .direction = { 0, 1, 0 }, .radiance = color },
    };
    for (size_t i = 0; i < sizeof lights / sizeof *lights; i++) {
        const reference_result result = estimate(&surface, &lights[i], wall_at_one);
        assert_int_equal(result.mean[1] > 0, i == 0);
        assert_true(estimate(&surface, &lights[i], NULL).mean[1] > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_light_falls_off_by_the_square_of_its_distance),
        cmocka_unit_test(a_spot_fades_between_its_cones),
        cmocka_unit_test(a_directional_light_gives_its_irradiance_times_the_cosine),
        cmocka_unit_test(a_cap_gives_the_irradiance_of_a_sphere_as_wide),
        cmocka_unit_test(a_tilted_surface_sees_sky_and_ground),
        cmocka_unit_test(a_lobe_of_exponent_0_is_flat),
        cmocka_unit_test(walls_hide_what_is_behind_them_and_nothing_before),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
