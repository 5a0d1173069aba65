/* SPDX-License-Identifier: MIT */
/* Derivatives of lights' coefficients against differences: of areas by quadrature in double, of
 * points and spots by their definitions. */
#include "tests/oracle/areas.h"

#include <stdlib.h>

enum { BANDS = 10, COUNT = BANDS * BANDS, BANDS_MANY = 48 };

/* The coefficients of a light of strength 1 at a point in double. */
typedef void project_exactly(const lmp_light *light, const double point[3], int bands, double *sh);

/* Computes d/dx, d/dy, d/dz by central differences of the fourth order. */
static void differences(project_exactly *project, const lmp_light *light, lmp_vec3 point, int bands,
                        double step, double *gradient) {
    static double sh[4][LMP_SH_COUNT(BANDS_MANY)];
    static const double offset[4] = { -2, -1, 1, 2 },
                        weight[4] = { 1. / 12, -2. / 3, 2. / 3, -1. / 12 };
    const int count = (int)LMP_SH_COUNT(bands);
    for (int a = 0; a < 3; a++) {
        for (int k = 0; k < 4; k++) {
            double at[3] = { (double)point.x, (double)point.y, (double)point.z };
            at[a] += offset[k] * step;
            project(light, at, bands, sh[k]);
        }
        for (int i = 0; i < count; i++) {
            double sum = 0;
            for (int k = 0; k < 4; k++)
                sum += weight[k] * sh[k][i];
            gradient[a * count + i] = sum / step;
        }
    }
}

/* Checks values and derivatives, in parts of the norm of either. */
static void check(project_exactly *project, const lmp_light *light, lmp_vec3 point, int bands,
                  double step, double bound) {
    static double expected[3 * LMP_SH_COUNT(BANDS_MANY)];
    static float sh[LMP_SH_COUNT(BANDS_MANY)], red[LMP_SH_COUNT(BANDS_MANY)],
        gradient[3 * LMP_SH_COUNT(BANDS_MANY)];
    const int count = (int)LMP_SH_COUNT(bands);
    lmp_light unit = *light;
    unit.radiance = (lmp_rgb) { 1, 0, 0 };
    lmp_light_project_gradient(bands, light, point, sh, gradient);
    lmp_light_project_channels(bands, &unit, 1, point, red, NULL, NULL);
    assert_memory_equal(sh, red, (size_t)count * sizeof *sh);
    differences(project, light, point, bands, step, expected);
    double norm2 = 0, error2 = 0;
    for (int i = 0; i < 3 * count; i++) {
        norm2 += expected[i] * expected[i];
        error2 += pow((double)gradient[i] - expected[i], 2);
    }
    CHECK_WITHIN(sqrt(error2), bound * sqrt(norm2) + 1e-30);
}

/* --- areas ------------------------------------------------------------------------------------ */

static double length_of(lmp_vec3 v) {
    return sqrt((double)v.x * (double)v.x + (double)v.y * (double)v.y + (double)v.z * (double)v.z);
}

static double dot_of(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* A point at 0.3 … 30 sizes from an area, off its plane by a tenth of that and outside a tube, and
 * a step that stays there. */
static lmp_vec3 point_beside(const random_area *a, double *step) {
    const bool tube = a->light.kind == LMP_LIGHT_TUBE;
    const double distance = a->size * pow(10, check_random_between(-0.5, 1.5));
    for (;;) {
        const lmp_vec3 direction = check_random_direction();
        const double away = tube ? a->size + (double)a->light.radius + distance : distance;
        const lmp_vec3 point = area_sum(a->light.position, away, direction);
        *step = 1e-3 * distance;
        if (tube || fabs(dot_of(direction, a->normal)) > 0.1)
            return point;
    }
}

static void check_areas(int each, int bands, double bound) {
    for (int k = 0; k < AREA_KINDS; k++)
        for (int i = 0; i < each; i++) {
            const random_area a = area_random(area_kinds[k]);
            double step;
            const lmp_vec3 point = point_beside(&a, &step);
            check(oracle_area_project, &a.light, point, bands, step, bound);
        }
}

static void areas_change_as_quadrature_does(void **state) {
    (void)state;
    check_areas(check_count(5, 80), BANDS, 2e-5);
}

static void areas_of_many_bands_change_as_quadrature_does(void **state) {
    (void)state;
    check_areas(1, check_count(16, BANDS_MANY), 1e-4);
}

/* Far away an area is a point of its size: solid angle S / d², which changes by -2 / d of it along
 * the way to it. Across, the direction changes as well. */
static void far_areas_change_as_points_do(void **state) {
    (void)state;
    for (int k = 0; k < AREA_KINDS; k++)
        for (int exponent = 3; exponent <= 9; exponent++) {
            const random_area a = area_random(area_kinds[k]);
            const double away = a.size * pow(10, exponent);
            const lmp_vec3 d = area_sum(a.normal, 0.5, a.x), none = { 0, 0, 0 };
            lmp_light light = a.light;
            light.two_sided = true;
            light.position = none;
            const lmp_vec3 point = area_sum(none, away / length_of(d), d);
            float sh[4], gradient[12];
            lmp_light_project_gradient(2, &light, point, sh, gradient);
            const double along =
                (dot_of(d, (lmp_vec3) { gradient[0], gradient[4], gradient[8] })) / length_of(d);
            const double most = 3 * pow(10, -exponent); /* of what is not a point */
            CHECK_WITHIN(fabs(along * away / (double)sh[0] + 2), 1e-4 + most);
            check(oracle_area_project, &light, point, 3, 1e-3 * away, 1e-4 + most);
        }
}

/* From behind, nothing changes; and from the front of a square its light grows toward it. */
static void one_side_changes(void **state) {
    (void)state;
    float sh[COUNT], gradient[3 * COUNT];
    const lmp_light square = area_square(false);
    lmp_light_project_gradient(BANDS, &square, (lmp_vec3) { 0.2f, 0, -1 }, sh, gradient);
    for (int i = 0; i < 3 * COUNT; i++)
        assert_true(gradient[i] == 0);
    lmp_light_project_gradient(BANDS, &square, (lmp_vec3) { 0, 0, 1 }, sh, gradient);
    assert_true(gradient[2 * COUNT] < 0);
    CHECK_WITHIN(fabs((double)gradient[0]), 1e-6);
    CHECK_WITHIN(fabs((double)gradient[COUNT]), 1e-6);
}

/* Beyond the end of a tube, only the sphere of its end is seen. */
static void a_tube_from_its_end_is_a_sphere(void **state) {
    (void)state;
    float tube[4 * COUNT], sphere[4 * COUNT];
    const lmp_light light = { .kind = LMP_LIGHT_TUBE, .half = { { 2, 0, 0 } }, .radius = 0.5f };
    const lmp_vec3 point = { 4, 0.2f, 0.1f };
    lmp_light_project_gradient(BANDS, &light, point, tube, tube + COUNT);
    lmp_sphere_project_gradient(BANDS, (lmp_vec3) { 2, 0, 0 }, 0.5f, point, sphere, sphere + COUNT);
    for (int i = 0; i < 4 * COUNT; i++)
        CHECK_WITHIN(fabs((double)(tube[i] - sphere[i])), 1e-5);
}

/* --- points and spots ------------------------------------------------------------------------- */

/* The definition: an intensity over the square of the distance, of a spot times the square of where
 * the cosine is between those of the cones. */
static void project_point(const lmp_light *light, const double point[3], int bands, double *sh) {
    const double to[3] = { (double)light->position.x - point[0],
                           (double)light->position.y - point[1],
                           (double)light->position.z - point[2] };
    const double d2 = to[0] * to[0] + to[1] * to[1] + to[2] * to[2], d = sqrt(d2);
    const double w[3] = { to[0] / d, to[1] / d, to[2] / d };
    double strength = 1 / d2;
    if (light->kind == LMP_LIGHT_SPOT) {
        const double cosine =
            -(w[0] * (double)light->direction.x + w[1] * (double)light->direction.y +
              w[2] * (double)light->direction.z);
        const double outer = cos((double)light->outer), inner = cos((double)light->inner);
        const double x = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
        strength *= x * x;
    }
    oracle_sh_eval(bands, w, sh);
    for (size_t i = 0; i < LMP_SH_COUNT(bands); i++)
        sh[i] *= strength;
}

static void points_and_spots_change_by_their_definitions(void **state) {
    (void)state;
    for (int i = 0; i < 200; i++) {
        lmp_light light = { .position = check_random_direction(), .inner = 0.2f, .outer = 1 };
        light.kind = i % 2 ? LMP_LIGHT_SPOT : LMP_LIGHT_POINT;
        light.direction = check_random_direction();
        const double d = pow(10, check_random_between(-2, 2));
        /* inside the outer cone, outside the inner, where the cone is smooth */
        const double angle = check_random_between(0.3, 0.9);
        lmp_vec3 x, y;
        area_frame(light.direction, &x, &y);
        const lmp_vec3 away =
            area_sum(area_sum((lmp_vec3) { 0, 0, 0 }, cos(angle), light.direction), sin(angle), x);
        check(project_point, &light, area_sum(light.position, d, away), BANDS, 1e-3 * d, 1e-4);
    }
}

static void other_lights(void **state) {
    (void)state;
    static const lmp_light lights[] = {
        { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0, 1, 0 }, .radiance = { 3, 2, 1 } },
        { .kind = LMP_LIGHT_CAP, .direction = { 0, 1, 0 }, .angle = 0.3f, .radiance = { 3, 2, 1 } },
        { .kind = LMP_LIGHT_HEMISPHERE, .direction = { 0, 1, 0 }, .ground = { 1, 1, 1 } },
    };
    const lmp_vec3 point = { 1, 2, 3 };
    float sh[COUNT], gradient[3 * COUNT], zonal[BANDS], expected[COUNT];
    for (int k = 0; k < 3; k++) {
        lmp_vec3 axis;
        lmp_light_project_gradient(BANDS, &lights[k], point, sh, gradient);
        lmp_light_project_zonal(BANDS, &lights[k], point, zonal, &axis);
        lmp_sh_expand_zonal(BANDS, zonal, axis, expected);
        for (int i = 0; i < COUNT; i++)
            CHECK_WITHIN(fabs((double)(sh[i] - expected[i])), 2e-6);
        for (int i = 0; i < 3 * COUNT; i++)
            assert_true(gradient[i] == 0);
    }
    float sphere[4 * COUNT];
    const lmp_light ball = { .position = { 0, 4, 0 }, .radius = 1, .radiance = { 5, 5, 5 } };
    lmp_light_project_gradient(BANDS, &ball, point, sh, gradient);
    lmp_sphere_project_gradient(BANDS, ball.position, 1, point, sphere, sphere + COUNT);
    assert_memory_equal(sh, sphere, sizeof sh);
    assert_memory_equal(gradient, sphere + COUNT, sizeof gradient);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(areas_change_as_quadrature_does),
        cmocka_unit_test(areas_of_many_bands_change_as_quadrature_does),
        cmocka_unit_test(far_areas_change_as_points_do),
        cmocka_unit_test(one_side_changes),
        cmocka_unit_test(a_tube_from_its_end_is_a_sphere),
        cmocka_unit_test(points_and_spots_change_by_their_definitions),
        cmocka_unit_test(other_lights),
    };
    cmocka_set_test_filter(getenv("LAMPION_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
