/* SPDX-License-Identifier: MIT */
/* Every kind of light against quadrature of its definition. */
#include "tests/oracle/check.h"
#include "tests/oracle/oracle.h"

#include <lampion/light.h>

#include <math.h>
#include <string.h>

enum { BANDS = 8, COUNT = BANDS * BANDS };

static const lmp_vec3 origin = { 0, 0, 0 };

static void wide(lmp_vec3 v, double w[3]) {
    w[0] = (double)v.x, w[1] = (double)v.y, w[2] = (double)v.z;
}

/* Compares the light's planes with `unit` times each channel of its color; the bound is relative.
 */
static void check_planes(const lmp_light *light, lmp_vec3 point, const double *unit,
                         lmp_rgb color) {
    float sh[3 * COUNT];
    double expected[3 * COUNT];
    const double channels[3] = { (double)color.r, (double)color.g, (double)color.b };
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < COUNT; k++)
            expected[c * COUNT + k] = channels[c] * unit[k];
    lmp_light_project(BANDS, light, 1, point, sh);
    CHECK_WITHIN(check_error(3 * COUNT, expected, sh), 1e-5);
}

/* Compares lmp_light_project_zonal with lmp_light_project for color 1. */
static void check_zonal(const lmp_light *light, lmp_vec3 point) {
    lmp_light white = *light;
    white.radiance = (lmp_rgb) { 1, 1, 1 };
    white.ground = (lmp_rgb) { 0, 0, 0 };
    float sh[3 * COUNT], zonal[BANDS], rotated[COUNT];
    double expected[COUNT];
    lmp_vec3 axis;
    lmp_light_project(BANDS, &white, 1, point, sh);
    lmp_light_project_zonal(BANDS, light, point, zonal, &axis);
    lmp_sh_expand_zonal(BANDS, zonal, axis, rotated);
    for (int k = 0; k < COUNT; k++)
        expected[k] = (double)sh[k];
    CHECK_WITHIN(check_error(COUNT, expected, rotated), 1e-5);
}

static void a_sphere_is_the_cap_it_covers(void **state) {
    (void)state;
    const float radii[] = { 1e-5f, 0.1f, 1.9f, 2, 2.1f, 50 };
    for (int i = 0; i < 6; i++) {
        const lmp_vec3 w = check_random_direction(), point = { 1, -1, 0.5f };
        const lmp_light light = { .kind = LMP_LIGHT_SPHERE,
                                  .position = { 1 + 2 * w.x, -1 + 2 * w.y, 0.5f + 2 * w.z },
                                  .radius = radii[i],
                                  .radiance = { 1, 2, 0.5f } };
        double center[3], receiver[3], expected[COUNT];
        wide(light.position, center);
        wide(point, receiver);
        oracle_sphere(BANDS, center, (double)radii[i], receiver, expected, NULL);
        if (radii[i] != 2) /* at the surface itself rounding decides on which side the point is */
            check_planes(&light, point, expected, light.radiance);
        check_zonal(&light, point);
        float sh[COUNT], zonal[BANDS];
        lmp_sphere_project(BANDS, light.position, radii[i], point, sh);
        double wide_sh[COUNT];
        for (int k = 0; k < COUNT; k++)
            wide_sh[k] = (double)sh[k];
        check_planes(&light, point, wide_sh, light.radiance);
        lmp_vec3 axis;
        lmp_light_project_zonal(BANDS, &light, point, zonal, &axis);
        CHECK_WITHIN(fabsf(axis.x - w.x) + fabsf(axis.y - w.y) + fabsf(axis.z - w.z), 2e-6);
    }
}

static void a_cap_is_its_quadrature_at_every_angle(void **state) {
    (void)state;
    const float angles[] = { 1e-4f, 0.00465f, 0.5f, 1.5f, 1.5707963f, 1.6f, 2.5f, 3.1415f };
    for (int i = 0; i < 8; i++) {
        const lmp_light light = { .kind = LMP_LIGHT_CAP,
                                  .direction = check_random_direction(),
                                  .angle = angles[i],
                                  .radiance = { 3, 2, 1 } };
        double w[3], expected[COUNT];
        wide(light.direction, w);
        oracle_cap(BANDS, w, 2 * pow(sin((double)angles[i] / 2), 2), expected);
        check_planes(&light, origin, expected, light.radiance);
        check_zonal(&light, origin);
    }
}

static void a_directional_light_is_a_dirac(void **state) {
    (void)state;
    const lmp_light light = { .kind = LMP_LIGHT_DIRECTIONAL,
                              .direction = check_random_direction(),
                              .irradiance = { 2, 3, 4 } };
    double w[3], expected[COUNT];
    wide(light.direction, w);
    oracle_sh_eval(BANDS, w, expected);
    check_planes(&light, origin, expected, light.irradiance);
    check_zonal(&light, origin);
}

static void a_point_light_falls_with_the_square_and_is_a_tiny_sphere(void **state) {
    (void)state;
    for (int i = -2; i <= 3; i++) {
        const float distance = powf(10, (float)i);
        const lmp_vec3 w = check_random_direction();
        const lmp_light light = { .kind = LMP_LIGHT_POINT,
                                  .position = { distance * w.x, distance * w.y, distance * w.z },
                                  .intensity = { 1, 2, 3 } };
        double position[3], expected[COUNT];
        wide(light.position, position);
        oracle_sh_eval(BANDS, position, expected);
        const double d2 =
            position[0] * position[0] + position[1] * position[1] + position[2] * position[2];
        for (int k = 0; k < COUNT; k++)
            expected[k] /= d2;
        check_planes(&light, origin, expected, light.intensity);
        check_zonal(&light, origin);

        const float radius = 1e-4f * distance;
        const float radiance = lmp_sphere_radiance_from_intensity(1, radius);
        const lmp_light sphere = { .position = light.position,
                                   .radius = radius,
                                   .radiance = { radiance, 2 * radiance, 3 * radiance } };
        check_planes(&sphere, origin, expected, light.intensity);
    }
}

static void a_point_light_stays_finite_where_it_is(void **state) {
    (void)state;
    const lmp_light light = { .kind = LMP_LIGHT_POINT, .intensity = { 1, 1, 1 } };
    float sh[3 * COUNT];
    lmp_light_project(BANDS, &light, 1, origin, sh);
    for (int k = 0; k < 3 * COUNT; k++)
        CHECK_WITHIN(fabsf(sh[k]), 1e13);
    assert_true(sh[0] > 0);
}

static void a_spot_light_fades_between_its_cones(void **state) {
    (void)state;
    const lmp_light spot = { .kind = LMP_LIGHT_SPOT,
                             .position = { 0, 0, 2 },
                             .direction = { 0, 0, -1 },
                             .inner = 0.3f,
                             .outer = 0.5f,
                             .intensity = { 1, 2, 3 } };
    for (int i = 0; i <= 20; i++) {
        const double angle = 0.04 * i, half_way = cos(angle);
        const lmp_vec3 point = { (float)(2 * tan(angle)), 0, 0 };
        double falloff = (half_way - cos(0.5)) / (cos(0.3) - cos(0.5));
        falloff = falloff < 0 ? 0 : falloff > 1 ? 1 : falloff * falloff;
        lmp_light bulb = spot;
        bulb.kind = LMP_LIGHT_POINT;
        float sh[3 * COUNT];
        double expected[COUNT];
        lmp_light_project(BANDS, &bulb, 1, point, sh);
        for (int k = 0; k < COUNT; k++)
            expected[k] = falloff * (double)sh[k];
        check_planes(&spot, point, expected, spot.intensity);
    }
    check_zonal(&spot, origin);
}

static void a_spot_light_with_equal_cones_has_a_hard_edge(void **state) {
    (void)state;
    lmp_light spot = { .kind = LMP_LIGHT_SPOT,
                       .position = { 0, 0, 1 },
                       .direction = { 0, 0, -1 },
                       .inner = 0.5f,
                       .outer = 0.5f,
                       .intensity = { 1, 1, 1 } };
    float sh[3 * COUNT];
    lmp_light_project(BANDS, &spot, 1, (lmp_vec3) { tanf(0.49f), 0, 0 }, sh);
    assert_true(sh[0] > 0.1f);
    const float full = sh[0];
    lmp_light_project(BANDS, &spot, 1, (lmp_vec3) { tanf(0.51f), 0, 0 }, sh);
    assert_true(sh[0] == 0);
    /* Halfway over the 1e-3 to which the difference of the cosines is clamped. */
    lmp_light_project(BANDS, &spot, 1, (lmp_vec3) { (float)tan(acos(cos(0.5) + 5e-4)), 0, 0 }, sh);
    CHECK_WITHIN(fabsf(sh[0] / full - 0.25f), 0.01);
}

typedef struct sky {
    double up[3];
} sky;

/* 1 above, 0 below */
static double sky_value(const double w[3], void *user) {
    const sky *above = user;
    return w[0] * above->up[0] + w[1] * above->up[1] + w[2] * above->up[2] > 0;
}

static void a_hemisphere_light_is_sky_and_ground(void **state) {
    (void)state;
    const lmp_light light = { .kind = LMP_LIGHT_HEMISPHERE,
                              .direction = { 0, 0, 1 },
                              .radiance = { 3, 1, 0 },
                              .ground = { 1, 2, 0.5f } };
    /* up = z: an even number of Gauss-Legendre nodes splits at the horizon, though not exactly */
    sky above = { { 0, 0, 1 } };
    double upper[COUNT], expected[3 * COUNT];
    oracle_project(BANDS, sky_value, &above, 200, upper);
    const double sky_color[3] = { 3, 1, 0 }, ground_color[3] = { 1, 2, 0.5 };
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < COUNT; k++)
            expected[c * COUNT + k] = (sky_color[c] - ground_color[c]) * upper[k] +
                                      (k == 0 ? ground_color[c] * 2 * sqrt(ORACLE_PI) : 0);
    float sh[3 * COUNT];
    lmp_light_project(BANDS, &light, 1, origin, sh);
    CHECK_WITHIN(check_error(3 * COUNT, expected, sh), 1e-4);

    /* any axis: two caps of a right angle, exactly */
    lmp_light rotated = light;
    rotated.direction = check_random_direction();
    double up[3], down[3], lower[COUNT];
    wide(rotated.direction, up);
    for (int k = 0; k < 3; k++)
        down[k] = -up[k];
    oracle_cap(BANDS, up, 1, upper);
    oracle_cap(BANDS, down, 1, lower);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < COUNT; k++)
            expected[c * COUNT + k] = sky_color[c] * upper[k] + ground_color[c] * lower[k];
    lmp_light_project(BANDS, &rotated, 1, origin, sh);
    CHECK_WITHIN(check_error(3 * COUNT, expected, sh), 1e-6);
    check_zonal(&rotated, origin);
}

static void lights_add_up(void **state) {
    (void)state;
    lmp_light lights[20];
    double expected[3 * COUNT] = { 0 };
    float sh[3 * COUNT];
    for (int i = 0; i < 20; i++) {
        lights[i] = (lmp_light) {
            .position = { (float)check_random_between(-3, 3), (float)check_random_between(-3, 3),
                          (float)check_random_between(-3, 3) },
            .radius = (float)check_random(),
            .radiance = { (float)check_random(), (float)check_random(), (float)check_random() }
        };
        lmp_light_project(BANDS, &lights[i], 1, origin, sh);
        for (int k = 0; k < 3 * COUNT; k++)
            expected[k] += (double)sh[k];
    }
    lmp_light_project(BANDS, lights, 20, origin, sh);
    CHECK_WITHIN(check_error(3 * COUNT, expected, sh), 1e-6);
    lmp_light_project(BANDS, NULL, 0, origin, sh);
    for (int k = 0; k < 3 * COUNT; k++)
        assert_true(sh[k] == 0);
}

/* Channels written one by one have the same bits, and nothing beside them changes. */
/* Many lights go side by side, each as it does alone: caps of every width, skies, spheres around
 * the point, spots whose edge is near it or that stand at it. */
static void many_lights_of_all_kinds_are_their_sum(void **state) {
    (void)state;
    enum { MANY = 70, MOST = 12, VALUES = 3 * LMP_SH_COUNT(MOST) };
    const lmp_vec3 point = { 3, -2, 0.5f };
    for (int trial = 0; trial < 40; trial++)
        for (int bands = 1; bands <= MOST; bands += 1 + bands / 6) {
            lmp_light lights[MANY];
            double expected[VALUES] = { 0 };
            float one[VALUES], all[VALUES];
            const size_t values = 3 * LMP_SH_COUNT(bands);
            for (int i = 0; i < MANY; i++) {
                const lmp_vec3 from = check_random_direction();
                const lmp_light_kind kind =
                    (lmp_light_kind)((trial + i) % (LMP_LIGHT_HEMISPHERE + 1));
                const bool is_center = kind == LMP_LIGHT_SPHERE && i % 4 == 0;
                const float d = is_center ? 0 : (float)check_random_between(0.2, 3);
                lights[i] =
                    (lmp_light) { .kind =
                                      (lmp_light_kind)((trial + i) % (LMP_LIGHT_HEMISPHERE + 1)),
                                  .position = { point.x + d * from.x, point.y + d * from.y,
                                                point.z + d * from.z },
                                  .direction = check_random_direction(),
                                  .radius = (float)check_random_between(0.01, 1),
                                  .angle = (float)check_random_between(0, 3.14),
                                  .inner = 0.4f,
                                  .outer = (float)check_random_between(0.6, 3),
                                  .radiance = { (float)check_random_between(0, 2), 1, 0.5f },
                                  .ground = { 0.3f, 0.1f, (float)check_random_between(0, 1) } };
                lmp_light_project(bands, &lights[i], 1, point, one);
                for (size_t k = 0; k < values; k++)
                    expected[k] += (double)one[k];
            }
            lmp_light_project(bands, lights, MANY, point, all);
            /* 70 roundings, and one of a direction, which changes band l by about l² / 2 of it */
            CHECK_WITHIN(check_error(values, expected, all), 1e-6 + 5e-8 * bands * bands);
        }
}

static void channels_go_where_they_belong(void **state) {
    (void)state;
    enum { STRIDE = COUNT + 7 };
    const lmp_light lights[2] = {
        { .position = { 1, 2, 3 }, .radius = 0.5f, .radiance = { 3, 2, 1 } },
        { .kind = LMP_LIGHT_HEMISPHERE,
          .direction = { 0, 1, 0 },
          .radiance = { 1, 2, 3 },
          .ground = { 0.25f, 0.5f, 1 } }
    };
    float sh[3 * COUNT], apart[3 * STRIDE];
    lmp_light_project(BANDS, lights, 2, origin, sh);
    for (int missing = -1; missing < 3; missing++) {
        float *planes[3];
        for (int i = 0; i < 3 * STRIDE; i++)
            apart[i] = -77;
        for (int c = 0; c < 3; c++)
            planes[c] = c == missing ? NULL : apart + c * STRIDE;
        lmp_light_project_channels(BANDS, lights, 2, origin, planes[0], planes[1], planes[2]);
        for (int c = 0; c < 3; c++) {
            for (int i = c == missing ? 0 : COUNT; i < STRIDE; i++)
                assert_true(apart[c * STRIDE + i] == -77);
            if (c != missing)
                assert_memory_equal(apart + c * STRIDE, sh + c * COUNT, COUNT * sizeof *sh);
        }
    }
}

/* --- units ------------------------------------------------------------------------------------ */

static void a_sphere_has_the_power_its_radiance_says(void **state) {
    (void)state;
    const float power = lmp_sphere_power_from_radiance(3, 0.5f);
    CHECK_WITHIN(fabs((double)power / (4 * ORACLE_PI * ORACLE_PI * 0.25 * 3) - 1), 1e-6);
    CHECK_WITHIN(fabsf(lmp_sphere_radiance_from_power(power, 0.5f) - 3), 1e-5);
    const float intensity = lmp_sphere_intensity_from_radiance(3, 0.5f);
    CHECK_WITHIN(fabs((double)intensity / (ORACLE_PI * 0.25 * 3) - 1), 1e-6);
    CHECK_WITHIN(fabsf(lmp_sphere_radiance_from_intensity(intensity, 0.5f) - 3), 1e-5);
    CHECK_WITHIN(fabs((double)(power / intensity) / (4 * ORACLE_PI) - 1), 1e-6);
}

/* All of a sphere's power arrives on any sphere around it: the irradiance of band 1 times 4 pi d².
 */
static void a_sphere_sends_its_power_through_any_shell(void **state) {
    (void)state;
    for (int i = 0; i < 4; i++) {
        const float distance = 0.6f + 3 * (float)i;
        float sh[4];
        lmp_sphere_project(2, (lmp_vec3) { 0, 0, distance }, 0.5f, origin, sh);
        /* ∫ L cos = sqrt(4 pi / 3) L_10 */
        const double irradiance = sqrt(4 * ORACLE_PI / 3) * (double)sh[2];
        const double power = 4 * ORACLE_PI * (double)(distance * distance) * irradiance;
        CHECK_WITHIN(fabs(power / (double)lmp_sphere_power_from_radiance(1, 0.5f) - 1), 2e-6);
    }
}

static void the_sun_has_the_radiance_its_irradiance_says(void **state) {
    (void)state;
    const float angle = (float)(0.2665 * ORACLE_PI / 180);
    CHECK_WITHIN(fabs((double)lmp_light_cap_radiance_from_irradiance(1, angle) / 14713 - 1), 1e-4);
    CHECK_WITHIN(fabsf(lmp_light_cap_irradiance_from_radiance(
                           lmp_light_cap_radiance_from_irradiance(2, angle), angle) -
                       2),
                 1e-5);
    CHECK_WITHIN(fabs((double)lmp_light_cap_irradiance_from_radiance(1, 1.5707963f) - ORACLE_PI),
                 1e-6);
}

/* Compares on either side of the range, for a light in front of the surface; irradiance is that of
 * the cap by light.h, of at most a hemisphere. */
static void a_light_is_no_more_than_was_asked_beyond_its_range(void **state) {
    (void)state;
    const float asked = 0.05f;
    for (int i = 0; i < 600; i++) {
        lmp_light light = { .kind = (lmp_light_kind)(i % 3),
                            .direction = check_random_direction(),
                            .radius = (float)check_random_between(0.01, 2),
                            .inner = 0.2f,
                            .outer = 0.4f,
                            .radiance = { (float)check_random_between(-9, 9), 0.01f,
                                          (float)check_random_between(0.1, 3) } };
        const float range = lmp_light_range(&light, asked);
        const float most = fmaxf(fabsf(light.radiance.r), light.radiance.b);
        const float distances[] = { 0.999f * range, 1.001f * range, 3 * range };
        for (int k = 0; k < 3; k++) {
            const lmp_vec3 w = light.direction;
            const lmp_vec3 point = { distances[k] * w.x, distances[k] * w.y, distances[k] * w.z };
            lmp_cap cap;
            lmp_light_find_cap(&light, point, &cap);
            const float there =
                fmaxf(fabsf(cap.strength.r), fmaxf(fabsf(cap.strength.g), fabsf(cap.strength.b)));
            assert_true(k == 0 ? there > asked : there <= asked);
            float sh[3 * COUNT];
            lmp_light_project(BANDS, &light, 1, point, sh);
            double squares = 0;
            for (int v = 0; v < COUNT; v++)
                squares += (double)sh[2 * COUNT + v] * (double)sh[2 * COUNT + v];
            if (k > 0)
                assert_true(sqrt(squares) <= BANDS / sqrt(ORACLE_PI) * (double)asked);
        }
        assert_true(range > 0 && most > 0);
        light.kind = LMP_LIGHT_SPHERE;
        assert_true(lmp_light_range(&light, 3.2f * most) == 0);
    }
}

static void lights_without_a_position_reach_everywhere_or_nowhere(void **state) {
    (void)state;
    const lmp_light sun = { .kind = LMP_LIGHT_DIRECTIONAL,
                            .direction = { 0, 1, 0 },
                            .irradiance = { 1, 3, 2 } };
    lmp_light cap = sun, above = sun;
    cap.kind = LMP_LIGHT_CAP;
    above.kind = LMP_LIGHT_HEMISPHERE;
    above.ground = (lmp_rgb) { 5, 0, 0 };
    const float angles[] = { 0.01f, 1, 2.5f };
    assert_true(lmp_light_range(&sun, 2.99f) == INFINITY && lmp_light_range(&sun, 3) == 0);
    assert_true(lmp_light_range(&above, 15.7f) == INFINITY && lmp_light_range(&above, 15.8f) == 0);
    for (int i = 0; i < 3; i++) {
        cap.angle = angles[i];
        const float most = lmp_light_cap_irradiance_from_radiance(3, fminf(angles[i], 1.5707963f));
        assert_true(lmp_light_range(&cap, 0.999f * most) == INFINITY);
        assert_true(lmp_light_range(&cap, 1.001f * most) == 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_is_the_cap_it_covers),
        cmocka_unit_test(a_cap_is_its_quadrature_at_every_angle),
        cmocka_unit_test(a_directional_light_is_a_dirac),
        cmocka_unit_test(a_point_light_falls_with_the_square_and_is_a_tiny_sphere),
        cmocka_unit_test(a_point_light_stays_finite_where_it_is),
        cmocka_unit_test(a_light_is_no_more_than_was_asked_beyond_its_range),
        cmocka_unit_test(lights_without_a_position_reach_everywhere_or_nowhere),
        cmocka_unit_test(a_spot_light_fades_between_its_cones),
        cmocka_unit_test(a_spot_light_with_equal_cones_has_a_hard_edge),
        cmocka_unit_test(a_hemisphere_light_is_sky_and_ground),
        cmocka_unit_test(lights_add_up),
        cmocka_unit_test(many_lights_of_all_kinds_are_their_sum),
        cmocka_unit_test(channels_go_where_they_belong),
        cmocka_unit_test(a_sphere_has_the_power_its_radiance_says),
        cmocka_unit_test(a_sphere_sends_its_power_through_any_shell),
        cmocka_unit_test(the_sun_has_the_radiance_its_irradiance_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
