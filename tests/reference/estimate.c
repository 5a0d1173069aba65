/* SPDX-License-Identifier: MIT */
/* The ground truth itself: Monte Carlo and quadrature against closed forms and each other. */
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_quadrature.h"
#include "tests/oracle/check.h"

#include <lampion/shade.h>

#include <string.h>

static const reference_band_limit whole = { .bands = 0 };
static const reference_vec origin = { 0, 0, 0 }, up = { 0, 1, 0 };
static const reference_material white = { .diffuse = { 1, 1, 1 }, .exponent = 1 };

static reference_vec unit(double x, double y, double z) {
    return reference_normalize((reference_vec) { x, y, z });
}

static scene_light light_at(double x, double y, double z, double radius) {
    return (scene_light) {
        .emitter = { .position = { (float)x, (float)y, (float)z },
                     .radius = (float)radius,
                     .radiance = { 1, 2, 4 } },
    };
}

static reference_surface surface_of(const reference_band_limit *limit,
                                    const reference_material *material, reference_vec view) {
    reference_surface surface;
    reference_surface_set(&surface, limit, material, origin, up, view);
    return surface;
}

static reference_result estimate(const reference_surface *surface, const scene_light *lights,
                                 size_t count, int samples, uint64_t key) {
    reference_estimator estimator;
    const reference_stop stop = { .samples = samples };
    assert_true(reference_estimator_create(&estimator, lights, count));
    const reference_result result = reference_estimate(&estimator, surface, &stop, key);
    reference_estimator_free(&estimator);
    return result;
}

/* Checks a result to three standard errors, and to rounding where there is no noise. */
static void check_result(const reference_result *result, const double truth[3]) {
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabs(result->mean[c] - truth[c]),
                     3 * result->standard_error[c] + 1e-12 * fabs(truth[c]));
}

static double irradiance(const scene_light *light) {
    const double d2 = (double)light->emitter.position.x * (double)light->emitter.position.x +
                      (double)light->emitter.position.y * (double)light->emitter.position.y +
                      (double)light->emitter.position.z * (double)light->emitter.position.z;
    return REFERENCE_PI * (double)light->emitter.radius * (double)light->emitter.radius / d2 *
           (double)light->emitter.position.y / sqrt(d2);
}

/* E = pi L sin²a cos(theta); a white diffuse surface reflects E/pi. */
static void irradiance_of_a_sphere_above_the_horizon(void **state) {
    (void)state;
    const double cases[][4] = { { 0, 1, 0, 0.5 },     { 0, 1, 0, 0.999 }, { 2, 1, -1, 0.75 },
                                { 30, 40, 0, 0.125 }, { 1, 8, 1, 0.001 }, { 0, 3, 4, 2.5 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const scene_light light = light_at(cases[i][0], cases[i][1], cases[i][2], cases[i][3]);
        const reference_surface surface = surface_of(&whole, &white, up);
        const reference_result result = estimate(&surface, &light, 1, 4096, i);
        const double e = irradiance(&light) / REFERENCE_PI;
        const double truth[3] = { e, 2 * e, 4 * e };
        double exact[3];
        check_result(&result, truth);
        reference_quadrature(&surface, &light, 1, exact);
        CHECK_WITHIN(fabs(exact[0] - e) / e, 1e-9);
    }
}

/* A lobe much narrower than the light it looks at reflects the light's radiance, and none beside
 * it. */
static void a_mirror_like_lobe_shows_the_light(void **state) {
    (void)state;
    const reference_material mirror = { .specular = { 0.5, 0.5, 0.5 }, .exponent = 100000 };
    const scene_light light = light_at(3, 4, 0, 1);
    const reference_surface at_it = surface_of(&whole, &mirror, unit(-3, 4, 0));
    const reference_surface beside = surface_of(&whole, &mirror, unit(-3, 2, 0));
    const reference_result seen = estimate(&at_it, &light, 1, 1024, 7);
    const reference_result unseen = estimate(&beside, &light, 1, 1024, 7);
    const double truth[3] = { 0.5, 1, 2 }, none[3] = { 0 };
    check_result(&seen, truth);
    check_result(&unseen, none);
    CHECK_WITHIN(seen.standard_error[0], 0.01);
}

/* Inside, light is ambient: E = pi L, and a whole lobe returns its weight. */
static void the_inside_of_a_glowing_sphere_is_lit_from_everywhere(void **state) {
    (void)state;
    const reference_material both = { { 0.5, 0.5, 0.5 }, { 0.25, 0.25, 0.25 }, 20 };
    const double truth[3] = { 0.75, 1.5, 3 };
    for (int i = 0; i < 3; i++) {
        const scene_light light = light_at(0.25 * i, 0.4 * i, -0.1 * i, 1);
        const reference_surface surface = surface_of(&whole, &both, unit(1, 1, 0));
        const reference_result result = estimate(&surface, &light, 1, 4096, (uint64_t)i);
        double exact[3];
        check_result(&result, truth);
        reference_quadrature(&surface, &light, 1, exact);
        CHECK_WITHIN(check_error_double(3, truth, exact), 1e-9);
    }
}

/* A sphere whose center lies on the horizon is seen by half: E = L (a - sin a cos a), by
 * integrating y over the half cap. */
static void the_horizon_cuts_a_light(void **state) {
    (void)state;
    for (int i = 1; i < 10; i++) {
        const scene_light light = light_at(1, 0, 0, 0.1 * i);
        const double s = (double)light.emitter.radius, a = asin(s);
        const double e = (a - s * cos(a)) / REFERENCE_PI, truth[3] = { e, 2 * e, 4 * e };
        const reference_surface surface = surface_of(&whole, &white, up);
        const reference_result result = estimate(&surface, &light, 1, 4096, (uint64_t)i);
        double exact[3];
        check_result(&result, truth);
        reference_quadrature(&surface, &light, 1, exact);
        CHECK_WITHIN(check_error_double(3, truth, exact), 1e-9);
    }
}

static void random_lights(scene_light *lights, int count) {
    for (int i = 0; i < count; i++) {
        const lmp_vec3 d = check_random_direction();
        const double distance = check_random_between(0.5, 10);
        lights[i] = light_at((double)d.x * distance, (double)d.y * distance, (double)d.z * distance,
                             check_random_between(0.01, 2));
    }
}

static void monte_carlo_equals_quadrature_for_many_lights(void **state) {
    (void)state;
    int outside = 0, values = 0;
    for (int i = 0; i < 60; i++) {
        const reference_band_limit limit = { .bands = i % 3 ? 0 : 3 + i / 3,
                                             .window = (lmp_window)(i % 2) };
        const reference_material material = { { 0.6, 0.3, 0.1 }, { 0.1, 0.4, 0.8 }, pow(1.2, i) };
        scene_light lights[12];
        random_lights(lights, 12);
        const reference_surface surface = surface_of(&limit, &material, unit(-1, 0.1 * i, 0.5));
        const reference_result result = estimate(&surface, lights, 12, 2048, (uint64_t)i);
        double exact[3];
        reference_quadrature(&surface, lights, 12, exact);
        for (int c = 0; c < 3; c++, values++) {
            outside += !(fabs(result.mean[c] - exact[c]) <= 2 * result.standard_error[c]);
            CHECK_WITHIN(fabs(result.mean[c] - exact[c]), 5 * result.standard_error[c]);
        }
    }
    /* 5 % lie outside two standard errors; the channels are correlated. */
    CHECK_WITHIN((double)outside / values, 0.12);
}

/* Computes the root mean square error over 256 streams at 4 octaves of samples: each must be the
 * one before over sqrt 2, and what the standard error says. A bias would flatten the curve. */
static void the_error_falls_as_one_over_the_root_of_the_samples(void **state) {
    (void)state;
    const reference_material material = { { 0.5, 0.5, 0.5 }, { 0.5, 0.5, 0.5 }, 50 };
    const scene_light lights[2] = { light_at(1, 1, 0, 0.8), light_at(-1, 0.2, 1, 0.9) };
    const reference_surface surface = surface_of(&whole, &material, unit(-1, 1, 0));
    double exact[3], before = 0;
    reference_quadrature(&surface, lights, 2, exact);
    for (int samples = 32; samples <= 512; samples *= 2) {
        double squares = 0, said = 0;
        for (uint64_t stream = 0; stream < 1024; stream++) {
            const reference_result r =
                estimate(&surface, lights, 2, samples, stream + 1024 * (uint64_t)samples);
            squares += (r.mean[1] - exact[1]) * (r.mean[1] - exact[1]) / 1024;
            said += r.standard_error[1] * r.standard_error[1] / 1024;
        }
        CHECK_WITHIN(fabs(squares / said - 1), 0.2);
        if (before > 0)
            CHECK_WITHIN(fabs(squares / before - 0.5), 0.12);
        before = squares;
    }
}

static double at_wall(reference_vec point, reference_vec direction, void *user) {
    (void)point;
    (void)user;
    return direction.x > 0 ? 2 : (double)INFINITY;
}

static void a_light_behind_a_wall_is_hidden(void **state) {
    (void)state;
    const scene_light lights[3] = { light_at(3, 1, 0, 0.5), light_at(-3, 1, 0, 0.5),
                                    light_at(1, 1, 0, 0.3) };
    const reference_surface surface = surface_of(&whole, &white, up);
    reference_estimator estimator;
    const reference_stop stop = { .samples = 4096 };
    const double e = (irradiance(&lights[1]) + irradiance(&lights[2])) / REFERENCE_PI;
    const double truth[3] = { e, 2 * e, 4 * e };
    assert_true(reference_estimator_create(&estimator, lights, 3));
    estimator.visibility = at_wall;
    const reference_result result = reference_estimate(&estimator, &surface, &stop, 3);
    reference_estimator_free(&estimator);
    check_result(&result, truth);
}

static void sampling_stops_at_the_wanted_error(void **state) {
    (void)state;
    const scene_light light = light_at(1, 0, 0, 0.5);
    const reference_surface surface = surface_of(&whole, &white, up);
    reference_estimator estimator;
    const reference_stop stop = { .samples = 100000, .error = 0.01 };
    assert_true(reference_estimator_create(&estimator, &light, 1));
    const reference_result result = reference_estimate(&estimator, &surface, &stop, 3);
    reference_estimator_free(&estimator);
    CHECK_WITHIN(result.standard_error[0] / result.mean[0], 0.01);
    assert_in_range(result.samples, 16, 50000);
}

/* Integrates lambda_l = 2 pi ∫ k(t) P_l(t) dt. */
typedef struct moment {
    const reference_lobe *lobe;
    int degree;
} moment;

static double moment_at(double angle, void *user) {
    const moment *m = user;
    const double t = cos(angle);
    double before = 0, p = 1;
    for (int l = 0; l < m->degree; l++) {
        const double next = ((2 * l + 1) * t * p - l * before) / (l + 1);
        before = p;
        p = next;
    }
    return 2 * REFERENCE_PI * reference_lobe_at(m->lobe, t) * p * sin(angle);
}

static void the_series_of_a_lobe_is_its_definition(void **state) {
    (void)state;
    const double exponents[] = { 0.5, 1, 2, 7.3, 60, 1000 };
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        const reference_material material = { { 0 }, { 1, 1, 1 }, exponents[i] };
        const reference_band_limit limit = { .bands = 30 };
        const reference_surface full = surface_of(&whole, &material, up);
        const reference_surface series = surface_of(&limit, &material, up);
        for (int l = 0; l < 30; l++) {
            moment m = { &full.lobes[1], l };
            double lambda = 0;
            for (int part = 0; part < 8; part++)
                lambda += reference_integrate(moment_at, &m, REFERENCE_PI / 2 * part / 8,
                                              REFERENCE_PI / 2 * (part + 1) / 8);
            CHECK_WITHIN(fabs(series.lobes[1].series[l] * 4 * REFERENCE_PI / (2 * l + 1) - lambda),
                         1e-11);
        }
    }
}

static void the_series_comes_back_as_the_lobe(void **state) {
    (void)state;
    const reference_material material = { { 1, 1, 1 }, { 1, 1, 1 }, 20 };
    const reference_band_limit limit = { .bands = 60 };
    const reference_surface full = surface_of(&whole, &material, up);
    const reference_surface series = surface_of(&limit, &material, up);
    for (double u = -1; u <= 1; u += 0.01)
        CHECK_WITHIN(
            fabs(reference_lobe_at(&series.lobes[1], u) - reference_lobe_at(&full.lobes[1], u)),
            1e-9);
}

/* Returns the largest difference of the truncated series from the whole lobe, over angles and light
 * sizes, relative to the response's peak. */
static double cost_of_cutting(double exponent, int bands) {
    const double sizes[] = { 0.9, 0.5, 0.1 };
    const reference_material material = { { 0 }, { 1, 1, 1 }, exponent };
    const reference_band_limit limit = { .bands = bands };
    double worst = 0;
    for (int i = 0; i < 3; i++) {
        double peak = 0, largest = 0;
        for (int k = 0; k <= 200; k++) {
            const double angle = acos(1 - 1.6 * k / 200);
            const scene_light light = light_at(sin(angle), cos(angle), 0, sizes[i]);
            const reference_surface full = surface_of(&whole, &material, up);
            const reference_surface series = surface_of(&limit, &material, up);
            double exact[3], ringing[3];
            reference_quadrature(&full, &light, 1, exact);
            reference_quadrature(&series, &light, 1, ringing);
            peak = fmax(peak, exact[0]);
            largest = fmax(largest, fabs(ringing[0] - exact[0]));
        }
        worst = fmax(worst, largest / peak);
    }
    return worst;
}

/* Values of an independent computation at 40 digits, given to two digits. */
static void cutting_a_lobe_costs_what_the_theory_says(void **state) {
    (void)state;
    const struct {
        double exponent;
        int bands;
        double cost;
    } cases[] = { { 1, 20, 2.7e-3 },
                  { 20, 5, 5.3e-1 },
                  { 20, 10, 7.2e-2 },
                  { 20, 20, 2.5e-6 },
                  { 200, 20, 1.9e-1 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        CHECK_WITHIN(fabs(cost_of_cutting(cases[i].exponent, cases[i].bands) / cases[i].cost - 1),
                     0.05);
}

static reference_result estimate_tabulated(const reference_material_source *source,
                                           reference_vec view, const scene_light *lights,
                                           size_t count) {
    reference_tabulated tabulated;
    reference_surface surface = surface_of(&whole, &white, view);
    assert_true(reference_tabulated_create(&tabulated, source, 1));
    reference_tabulated_orient(&tabulated, source, up, (reference_vec) { 1, 0, 0 }, view);
    reference_surface_measure(&surface, &tabulated, up, view);
    const reference_result result = estimate(&surface, lights, count, 20000, 11);
    reference_tabulated_free(&tabulated);
    return result;
}

/* f_r cos(theta) of Lambert is the diffuse lobe; of Phong seen head-on it is a lobe of exponent
 * e + 1 times (e+2)/(e+2). */
static void brdfs_reflect_as_their_lobes(void **state) {
    (void)state;
    lmp_brdf *lambert = NULL, *phong = NULL;
    scene_light lights[5];
    random_lights(lights, 5);
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 0.5f, 0.25f, 1 }, &lambert), LMP_OK);
    assert_int_equal(lmp_brdf_create_phong(NULL, (lmp_rgb) { 0.5f, 0.25f, 1 }, 20, &phong), LMP_OK);
    const reference_material diffuse = { .diffuse = { 0.5, 0.25, 1 } };
    const reference_material lobe = { .specular = { 0.5, 0.25, 1 }, .exponent = 21 };
    for (int i = 0; i < 2; i++) {
        const reference_material_source source = { .brdf = i ? phong : lambert };
        const reference_surface surface = surface_of(&whole, i ? &lobe : &diffuse, up);
        const reference_result result = estimate_tabulated(&source, up, lights, 5);
        double exact[3];
        reference_quadrature(&surface, lights, 5, exact);
        check_result(&result, exact);
    }
    lmp_brdf_destroy(lambert);
    lmp_brdf_destroy(phong);
}

/* A smoothed normal may face away from the viewer at a silhouette: a BRDF, which is 0 below the
 * horizon, then reflects as on it, and a diffuse one as from anywhere. */
static void views_below_the_horizon_are_raised(void **state) {
    (void)state;
    lmp_brdf *lambert = NULL;
    assert_int_equal(lmp_brdf_create_lambert(NULL, (lmp_rgb) { 0.5f, 0.25f, 1 }, &lambert), LMP_OK);
    const reference_material_source source = { .brdf = lambert };
    reference_tabulated tabulated;
    assert_true(reference_tabulated_create(&tabulated, &source, 1));
    for (int degrees = 80; degrees <= 110; degrees += 5) {
        const double angle = degrees * acos(-1) / 180;
        const reference_vec view = { sin(angle), cos(angle), 0 };
        double rgb[3];
        reference_tabulated_orient(&tabulated, &source, up, (reference_vec) { 1, 0, 0 }, view);
        reference_tabulated_at(&tabulated, (reference_vec) { 0, 0.6, 0.8 }, rgb);
        CHECK_WITHIN(fabs(rgb[1] - 0.25 * 0.6 / acos(-1)), 1e-7);
    }
    reference_tabulated_free(&tabulated);
    lmp_brdf_destroy(lambert);
}

static void check_table(float across) {
    const lmp_ggx ggx = { 0.3f, across, { 0.5f, 0.4f, 0.3f }, { 0.2f, 0.3f, 0.4f } };
    const lmp_brdf_table_desc desc = { .bands = 7 };
    lmp_brdf *brdf = NULL;
    lmp_brdf_table *table = NULL;
    assert_int_equal(lmp_brdf_create_ggx(NULL, &ggx, &brdf), LMP_OK);
    assert_int_equal(lmp_brdf_table_create(NULL, &desc, brdf, &table), LMP_OK);
    for (int i = 0; i < 6; i++) {
        const reference_vec view = unit(0.4 * i - 1, 1, 0.3 * i);
        const lmp_surface surface = { .normal = { 0, 1, 0 },
                                      .view = { (float)view.x, (float)view.y, (float)view.z },
                                      .tangent = { 1, 0, 0 } };
        const lmp_material by_table = { .kind = LMP_MATERIAL_TABLE, .table = table };
        scene_light lights[4];
        lmp_light spheres[4];
        random_lights(lights, 4);
        for (int k = 0; k < 4; k++)
            spheres[k] = lights[k].emitter;
        const lmp_rgb c = lmp_shade(NULL, &by_table, &surface, spheres, 4);
        const reference_material_source source = { .coefficients =
                                                       lmp_brdf_table_coefficients(table),
                                                   .table = lmp_brdf_table_describe(table) };
        const reference_result result = estimate_tabulated(&source, view, lights, 4);
        const double shaded[3] = { (double)c.r, (double)c.g, (double)c.b };
        for (int k = 0; k < 3; k++)
            CHECK_WITHIN(fabs((result.mean[k] < 0 ? 0 : result.mean[k]) - shaded[k]),
                         4 * result.standard_error[k] + 1e-4 * shaded[k]);
    }
    lmp_brdf_table_destroy(table);
    lmp_brdf_destroy(brdf);
}

static void tables_reflect_as_the_library_shades_them(void **state) {
    (void)state;
    check_table(0);
    check_table(0.6f);
}

static void windows_have_the_documented_weights(void **state) {
    (void)state;
    const double hanning[] = { 1, .9755, .9045, .7939, .6545, .5, .3455, .2061, .0955, .0245 };
    const double lanczos[] = { 1, .9836, .9355, .8584, .7568, .6366, .5046, .3679, .2339, .1093 };
    const reference_material material = { { 0 }, { 1, 1, 1 }, 7 };
    for (int kind = 0; kind < 2; kind++) {
        const reference_band_limit plain = { .bands = 10 };
        const reference_band_limit limit = { 10, kind ? LMP_WINDOW_LANCZOS : LMP_WINDOW_HANNING,
                                             0 };
        const reference_surface a = surface_of(&plain, &material, up);
        const reference_surface b = surface_of(&limit, &material, up);
        for (int l = 0; l < 9; l++)
            CHECK_WITHIN(fabs(b.lobes[1].series[l] / a.lobes[1].series[l] -
                              (kind ? lanczos[l] : hanning[l])),
                         5.1e-5);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(irradiance_of_a_sphere_above_the_horizon),
        cmocka_unit_test(a_mirror_like_lobe_shows_the_light),
        cmocka_unit_test(the_inside_of_a_glowing_sphere_is_lit_from_everywhere),
        cmocka_unit_test(the_horizon_cuts_a_light),
        cmocka_unit_test(monte_carlo_equals_quadrature_for_many_lights),
        cmocka_unit_test(the_error_falls_as_one_over_the_root_of_the_samples),
        cmocka_unit_test(a_light_behind_a_wall_is_hidden),
        cmocka_unit_test(sampling_stops_at_the_wanted_error),
        cmocka_unit_test(the_series_of_a_lobe_is_its_definition),
        cmocka_unit_test(the_series_comes_back_as_the_lobe),
        cmocka_unit_test(cutting_a_lobe_costs_what_the_theory_says),
        cmocka_unit_test(brdfs_reflect_as_their_lobes),
        cmocka_unit_test(views_below_the_horizon_are_raised),
        cmocka_unit_test(tables_reflect_as_the_library_shades_them),
        cmocka_unit_test(windows_have_the_documented_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
