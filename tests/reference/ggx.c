/* SPDX-License-Identifier: MIT */
/* glTF's metallic-roughness in the ground truth, against appendix B of glTF 2.0 integrated over
 * caps independently (tests/oracle/gltf.h). */
#include "app/truth/reference_estimate.h"
#include "app/truth/reference_quadrature.h"
#include "tests/oracle/check.h"
#include "tests/oracle/gltf.h"

#include <string.h>

static const reference_vec origin = { 0, 0, 0 }, up = { 0, 0, 1 };
static const reference_band_limit whole = { .bands = 0 };
static const reference_dielectric common = { { 0.04, 0.04, 0.04 }, 1 };

static reference_vec direction(double to, double azimuth) {
    return (reference_vec) { sin(to) * cos(azimuth), sin(to) * sin(azimuth), cos(to) };
}

/* Returns a surface at the origin, seen from a direction at azimuth 180 degrees. */
static reference_ggx ggx_of(double base, double metallic, const reference_dielectric *layer,
                            double alpha, double view) {
    const double color[3] = { base, base, base };
    reference_ggx ggx;
    reference_ggx_set(&ggx, color, metallic, sqrt(alpha), layer, up, direction(view, REFERENCE_PI));
    return ggx;
}

static reference_result estimate(const reference_ggx *ggx, const reference_band_limit *limit,
                                 double view, const scene_light *light, int samples) {
    reference_surface surface = { .position = origin, .ray_origin = origin };
    reference_estimator estimator;
    const reference_stop stop = { .samples = samples };
    reference_surface_shine(&surface, limit, ggx, up, direction(view, REFERENCE_PI));
    assert_true(reference_estimator_create(&estimator, light, 1));
    const reference_result result =
        reference_estimate(&estimator, &surface, &stop, (uint64_t)(1e6 * check_random()));
    reference_estimator_free(&estimator);
    return result;
}

static scene_light sphere(reference_vec axis, double half_angle) {
    return (scene_light) { .emitter = { .position = { 10 * (float)axis.x, 10 * (float)axis.y,
                                                      10 * (float)axis.z },
                                        .radius = 10 * (float)sin(half_angle),
                                        .radiance = { 1, 1, 1 } } };
}

/* Returns the value of metal and dielectric mixed, in which appendix B is linear. */
static double exact(double base, double metallic, const reference_dielectric *layer, double alpha,
                    double view, const scene_light *of, double half_angle) {
    const oracle_gltf metal = { alpha, view, base, 1, 0 };
    const oracle_gltf dielectric = { alpha, view, layer->f0[0], layer->f90, base };
    const lmp_vec3 p = of->emitter.position;
    const double middle[3] = { (double)p.x / 10, (double)p.y / 10, (double)p.z / 10 };
    return metallic * oracle_gltf_cap(&metal, middle, half_angle) +
           (1 - metallic) * oracle_gltf_cap(&dielectric, middle, half_angle);
}

static void reflection_is_that_of_the_specification(void **state) {
    (void)state;
    static const double alphas[] = { 0.001, 0.01, 0.1, 0.3, 1 }, views[] = { 0, 0.5, 1.2, 1.5 };
    int outside = 0, count = 0;
    double noise = 0;
    for (int i = 0; i < 5; i++)
        for (int v = 0; v < 4; v++)
            for (int k = 0; k < 9; k++) {
                /* directions around the mirror direction, beside it, and anywhere */
                const double off = k % 3 == 0 ? 0.5 * alphas[i] : k % 3 == 1 ? 3 * alphas[i] : 1;
                const double to = fmin(fabs(views[v] + off * check_random_between(-1, 1)), 1.6);
                const double half_angle = k < 3 ? 0.02 : k < 6 ? 0.2 : 0.9;
                const double base = check_random(), metallic = k % 2 ? 1 : check_random();
                const double f90 = check_random(), f0 = f90 * check_random();
                const reference_dielectric own = { { f0, f0, f0 }, f90 };
                const reference_dielectric layer = k % 4 ? common : own;
                const scene_light light =
                    sphere(direction(to, off * check_random_between(-1, 1)), half_angle);
                const reference_ggx ggx = ggx_of(base, metallic, &layer, alphas[i], views[v]);
                const reference_result r = estimate(&ggx, &whole, views[v], &light, 4096);
                const double truth =
                    exact(base, metallic, &layer, alphas[i], views[v], &light, half_angle);
                const double error = fabs(r.mean[0] - truth);
                count++;
                outside += !(error <= 3 * r.standard_error[0] + 1e-5);
                noise = fmax(noise, r.standard_error[0] / fmax(truth, 1e-3));
                CHECK_WITHIN(error, 6 * r.standard_error[0] + 1e-5);
            }
    print_message("%d of %d outside 3 standard errors, the largest of them %.3f of the value\n",
                  outside, count, noise);
    assert_in_range(outside, 0, count / 20);
    CHECK_WITHIN(noise, 0.1);
}

/* GGX over GGX reflects the coat's fraction, and the rest of what is under it. */
static void a_coated_surface_is_estimated_without_bias(void **state) {
    (void)state;
    const double views[] = { 0, 0.7, 1.2 }, weights[] = { 1, 0.5 };
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 6; k++) {
            const reference_vec view = direction(views[v], REFERENCE_PI);
            const scene_light light =
                sphere(direction(views[v] + check_random_between(-0.3, 0.3), 0.1), 0.3);
            const reference_ggx ggx = ggx_of(0.7, 0.5, &common, 0.5, views[v]);
            const double weight = weights[k % 2], rough = 0.2 + 0.1 * k;
            const double part = weight * (0.04 + 0.96 * pow(1 - cos(views[v]), 5));
            const oracle_gltf over = { rough * rough, views[v], 1, 1, 0 };
            const lmp_vec3 p = light.emitter.position;
            const double middle[3] = { (double)p.x / 10, (double)p.y / 10, (double)p.z / 10 };
            const double truth = (1 - part) * exact(0.7, 0.5, &common, 0.5, views[v], &light, 0.3) +
                                 part * oracle_gltf_cap(&over, middle, 0.3);
            reference_surface surface = { .position = origin, .ray_origin = origin };
            reference_ggx coat;
            reference_estimator estimator;
            reference_surface_shine(&surface, &whole, &ggx, up, view);
            reference_coat_set(&coat, weight, rough, up, view);
            reference_surface_coat(&surface, &coat, up, view);
            assert_true(reference_estimator_create(&estimator, &light, 1));
            const reference_result r =
                reference_estimate(&estimator, &surface, &(reference_stop) { .samples = 8192 }, 7);
            reference_estimator_free(&estimator);
            CHECK_WITHIN(fabs(r.mean[0] - truth), 5 * r.standard_error[0] + 1e-5);
            CHECK_WITHIN(r.standard_error[0], 0.05 * truth + 1e-4);
        }
}

/* The mean over its own samples of what a white metal reflects is at most 1. */
static void samples_follow_the_specular_part(void **state) {
    (void)state;
    const double alphas[] = { 0.001, 0.1, 0.5, 1 }, views[] = { 0, 0.8, 1.5 };
    for (int i = 0; i < 12; i++) {
        const double alpha = alphas[i / 3], view = views[i % 3];
        const reference_ggx ggx = ggx_of(1, 1, &common, alpha, view);
        const oracle_gltf metal = { alpha, view, 1, 1, 0 };
        const double expected = oracle_gltf_cap(&metal, (double[3]) { 0, 0, 1 }, REFERENCE_PI / 2);
        double sum = 0;
        const int samples = 20000;
        for (int k = 0; k < samples; k++) {
            const reference_vec w = reference_ggx_draw(&ggx, check_random(), check_random());
            double rgb[3];
            reference_ggx_at(&ggx, w, rgb);
            const double weight = rgb[0] / reference_ggx_density(&ggx, w);
            CHECK_WITHIN(weight, 1 + 1e-9);
            sum += weight / samples;
        }
        CHECK_WITHIN(fabs(sum - expected), 0.01);
    }
}

/* ∫ of a whole lobe times the light's series is ∫ of the lobe's series times the light. */
static void the_lights_series_does_what_the_lobes_would(void **state) {
    (void)state;
    const reference_material phong = { { 0.5, 0.5, 0.5 }, { 1, 1, 1 }, 12 };
    const reference_vec view = direction(0.6, REFERENCE_PI);
    for (int trial = 0; trial < 4; trial++) {
        const reference_band_limit limit = { trial % 2 ? 4 : 9,
                                             trial / 2 ? LMP_WINDOW_HANNING : LMP_WINDOW_NONE, 0 };
        const double half_angle = trial ? 0.3 : 1e-4;
        const scene_light light = sphere(direction(0.7, 0.4), half_angle);
        reference_surface truncated, free_of_bands;
        reference_source source[REFERENCE_SOURCES_MAX];
        double expected[3], series[LMP_BANDS_MAX], sum = 0;
        reference_surface_set(&truncated, &limit, &phong, origin, up, view);
        reference_quadrature(&truncated, &light, 1, expected);
        reference_surface_set(&free_of_bands, &whole, &phong, origin, up, view);
        reference_light_sources(&light, origin, true, source);
        reference_series_of_source(source, &limit, series);
        const int rings = 400, steps = 64;
        for (int i = 0; i < rings; i++)
            for (int k = 0; k < steps; k++) {
                const double z = 1 - 2 * (i + 0.5) / rings, azimuth = 2 * REFERENCE_PI * k / steps;
                const reference_vec w = direction(acos(z), azimuth);
                double reflected = 0;
                for (int lobe = 0; lobe < free_of_bands.lobe_count; lobe++) {
                    const reference_lobe *l = &free_of_bands.lobes[lobe];
                    reflected += l->weight[0] * reference_lobe_at(l, reference_dot(l->axis, w));
                }
                sum += reflected *
                       reference_series_at(limit.bands, series, reference_dot(w, source->axis));
            }
        sum *= 4 * REFERENCE_PI / rings / steps;
        CHECK_WITHIN(fabs(sum / expected[0] - 1), 2e-3);
    }
}

/* In many bands little is left out of a rough surface under a wide light. */
static void many_bands_come_near_the_whole(void **state) {
    (void)state;
    const reference_band_limit limit = { 60, LMP_WINDOW_NONE, 0 };
    const scene_light light = sphere(direction(0.5, 0.3), 0.4);
    const reference_ggx ggx = ggx_of(0.7, 0.5, &common, 0.4, 0.6);
    const reference_result truncated = estimate(&ggx, &limit, 0.6, &light, 40000);
    const double truth = exact(0.7, 0.5, &common, 0.4, 0.6, &light, 0.4);
    CHECK_WITHIN(fabs(truncated.mean[0] - truth), 4 * truncated.standard_error[0] + 1e-3 * truth);
    CHECK_WITHIN(truncated.standard_error[0], 0.02 * truth);
}

static double never(reference_vec point, reference_vec w, void *user) {
    (void)point;
    (void)w;
    (void)user;
    return (double)INFINITY;
}

/* Directions drawn in lights that may be hidden, but are not, give what the lights give. */
static void visible_lights_give_the_same_series(void **state) {
    (void)state;
    const reference_band_limit limit = { 5, LMP_WINDOW_HANNING, 0 };
    const scene_light light = sphere(direction(0.5, 0.3), 0.4);
    const reference_ggx ggx = ggx_of(0.7, 0.5, &common, 0.4, 0.6);
    const reference_result plain = estimate(&ggx, &limit, 0.6, &light, 20000);
    reference_surface surface = { .position = origin, .ray_origin = origin };
    reference_estimator estimator;
    const reference_stop stop = { .samples = 20000 };
    reference_surface_shine(&surface, &limit, &ggx, up, direction(0.6, REFERENCE_PI));
    assert_true(reference_estimator_create(&estimator, &light, 1));
    estimator.visibility = never;
    const reference_result drawn = reference_estimate(&estimator, &surface, &stop, 3);
    reference_estimator_free(&estimator);
    CHECK_WITHIN(fabs(drawn.mean[0] - plain.mean[0]),
                 4 * (drawn.standard_error[0] + plain.standard_error[0]));
}

/* Estimates under a light that may be hidden. */
static reference_result estimate_in_view(const reference_ggx *ggx, const scene_light *light) {
    const reference_band_limit limit = { 5, LMP_WINDOW_HANNING, 0 };
    const reference_stop stop = { .samples = 20000 };
    reference_surface surface = { .position = origin, .ray_origin = origin };
    reference_estimator estimator;
    reference_surface_shine(&surface, &limit, ggx, up, direction(0.6, REFERENCE_PI));
    assert_true(reference_estimator_create(&estimator, light, 1));
    estimator.visibility = never;
    const reference_result result = reference_estimate(&estimator, &surface, &stop, 3);
    reference_estimator_free(&estimator);
    return result;
}

/* Light of any color takes the samples that white takes; a metal's color decides the lobe they are
 * drawn from, but not what they come to. */
static void colors_of_series_are_estimated_as_white_is(void **state) {
    (void)state;
    const reference_vec view = direction(0.6, REFERENCE_PI);
    const double ones[3] = { 1, 1, 1 };
    scene_light light = sphere(direction(0.5, 0.3), 0.4);
    reference_ggx white, colored;
    reference_ggx_set(&white, ones, 1, sqrt(0.4), &common, up, view);
    const reference_result of_white = estimate_in_view(&white, &light);
    for (int c = 0; c < 3; c++) {
        double base[3] = { 0, 0, 0 };
        base[c] = 1;
        reference_ggx_set(&colored, base, 1, sqrt(0.4), &common, up, view);
        const reference_result result = estimate_in_view(&colored, &light);
        CHECK_WITHIN(fabs(result.mean[c] - of_white.mean[c]),
                     4 * (result.standard_error[c] + of_white.standard_error[c]));
        CHECK_WITHIN(result.standard_error[c], 0.05 * of_white.mean[c]);
    }
    light.emitter.radiance.r *= 0.5f;
    light.emitter.radiance.b *= 4;
    const reference_result by_light = estimate_in_view(&white, &light);
    const double parts[3] = { 0.5, 1, 4 };
    for (int c = 0; c < 3; c++)
        CHECK_WITHIN(fabs(by_light.mean[c] - of_white.mean[c] * parts[c]), 1e-6 * of_white.mean[c]);
}

/* When light and view rotate about the normal together, reflection, draws and densities stay the
 * same. */
static void rotating_light_and_view_together_changes_nothing(void **state) {
    (void)state;
    const double color[3] = { 0.7, 0.4, 0.2 };
    const reference_dielectric layer = { { 0.1, 0.05, 0.02 }, 0.8 };
    for (int i = 0; i < 40; i++) {
        const double to = check_random_between(0, 1.5), view = check_random_between(0, 1.5);
        const double apart = check_random_between(0, 6.3), alpha = check_random_between(0.05, 1);
        const double u = check_random(), v = check_random();
        double first[3] = { 0, 0, 0 }, density = 0, drawn = 0;
        for (int step = 0; step < 7; step++) {
            const reference_vec w = direction(view, 0.9 * step),
                                l = direction(to, 0.9 * step + apart);
            reference_ggx ggx;
            double rgb[3];
            reference_ggx_set(&ggx, color, 0.3, sqrt(alpha), &layer, up, w);
            reference_ggx_at(&ggx, l, rgb);
            const double here = reference_ggx_density(&ggx, l);
            const double along = reference_dot(reference_ggx_draw(&ggx, u, v), w);
            if (step == 0) {
                memcpy(first, rgb, sizeof first);
                density = here, drawn = along;
            }
            for (int c = 0; c < 3; c++)
                CHECK_WITHIN(fabs(rgb[c] - first[c]), 1e-9 * (1 + first[c]));
            CHECK_WITHIN(fabs(here - density), 1e-9 * (1 + density));
            CHECK_WITHIN(fabs(along - drawn), 1e-9);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reflection_is_that_of_the_specification),
        cmocka_unit_test(rotating_light_and_view_together_changes_nothing),
        cmocka_unit_test(a_coated_surface_is_estimated_without_bias),
        cmocka_unit_test(samples_follow_the_specular_part),
        cmocka_unit_test(the_lights_series_does_what_the_lobes_would),
        cmocka_unit_test(many_bands_come_near_the_whole),
        cmocka_unit_test(visible_lights_give_the_same_series),
        cmocka_unit_test(colors_of_series_are_estimated_as_white_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
