/* SPDX-License-Identifier: MIT */
/* Lights that are areas, against quadrature over their surface, and what follows from what they
 * are.
 */
#include "src/light/angle.h"
#include "tests/oracle/areas.h"

#include <lampion/cpu.h>

enum { BANDS = 10, COUNT = BANDS * BANDS, MOST = 48 };

static const lmp_vec3 origin = { 0, 0, 0 }, up = { 0, 0, 1 };

static void wide(lmp_vec3 v, double w[3]) {
    w[0] = (double)v.x, w[1] = (double)v.y, w[2] = (double)v.z;
}

static void wide_unit(lmp_vec3 v, double w[3]) {
    wide(v, w);
    const double length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    for (int i = 0; i < 3; i++)
        w[i] /= length;
}

static double norm(size_t count, const double *values) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += values[i] * values[i];
    return sqrt(sum);
}

/* Returns the largest difference in parts of the norm of what is expected. */
static double difference(size_t count, const double *expected, const float *actual) {
    const double all = norm(count, expected);
    double largest = 0;
    for (size_t i = 0; i < count; i++) {
        const double error = fabs((double)actual[i] - expected[i]);
        largest = error <= largest ? largest : error;
    }
    return all > 0 ? largest / all : largest;
}

static void widen(size_t count, const float *from, double *to) {
    for (size_t i = 0; i < count; i++)
        to[i] = (double)from[i];
}

/* --- quadrature ------------------------------------------------------------------------------- */

static double projection_error(const random_area *a, lmp_vec3 point, int bands) {
    static double expected[MOST * MOST];
    static float sh[3 * MOST * MOST];
    double p[3];
    wide(point, p);
    oracle_area_project(&a->light, p, bands, expected);
    lmp_light_project(bands, &a->light, 1, point, sh);
    return difference(LMP_SH_COUNT(bands), expected, sh);
}

/* Compares the response of a lobe of random factors, in parts of the largest that they permit. */
static double response_error(const random_area *a, lmp_vec3 point, int bands) {
    const lmp_vec3 axis = check_random_direction();
    float lambda[MOST];
    double p[3], q[3], moments[MOST], expected = 0, most = 0;
    wide(point, p);
    wide_unit(axis, q);
    oracle_area_moments(&a->light, p, bands, q, moments);
    for (int l = 0; l < bands; l++) {
        lambda[l] = (float)check_random_between(-1, 1);
        const double weight = (2 * l + 1) / (4 * ORACLE_PI) * (double)lambda[l];
        expected += weight * moments[l];
        most += fabs(weight) * moments[0];
    }
    const lmp_rgb e = lmp_lobe_response(bands, lambda, axis, &a->light, 1, point);
    return fabs((double)e.g - expected) / (most > 0 ? most : 1);
}

/* Compares the irradiance, in parts of that of a surface that faces the light. */
static double irradiance_error(const random_area *a, lmp_vec3 point, int bands) {
    const lmp_vec3 normal = check_random_direction();
    double p[3], n[3], facing[4];
    (void)bands;
    wide(point, p);
    wide_unit(normal, n);
    oracle_area_project(&a->light, p, 2, facing);
    const double most = norm(3, facing + 1) / sqrt(3 / (4 * ORACLE_PI));
    const double expected = oracle_area_irradiance(&a->light, p, n);
    const lmp_rgb e = lmp_light_irradiance(&a->light, 1, point, normal);
    return fabs((double)e.g - expected) / (most > 0 ? most : 1);
}

static void check_all(double (*error_of)(const random_area *, lmp_vec3, int), const char *what,
                      int bands, int count, double bound) {
    for (int k = 0; k < AREA_KINDS; k++) {
        double worst = 0;
        for (int i = 0; i < count; i++) {
            const random_area a = area_random(area_kinds[k]);
            const double error = error_of(&a, area_point(&a), bands);
            if (!(error <= worst))
                worst = error;
        }
        printf("%s, %s, %d bands: at most %.2g\n", area_names[k], what, bands, worst);
        CHECK_WITHIN(worst, bound);
    }
}

static void coefficients_are_the_integral_over_the_area(void **state) {
    (void)state;
    check_all(projection_error, "coefficients", BANDS, check_count(12, 2000), 2e-6);
    check_all(projection_error, "coefficients", MOST, check_count(3, 12), 2e-6);
}

static void lobes_respond_by_the_integral_over_the_area(void **state) {
    (void)state;
    check_all(response_error, "responses", BANDS, check_count(40, 2000), 2e-6);
    check_all(response_error, "responses", MOST, check_count(8, 400), 2e-6);
}

static void the_horizon_cuts_the_irradiance(void **state) {
    (void)state;
    check_all(irradiance_error, "irradiance", 2, check_count(20, 1000), 1e-6);
}

/* --- sides ------------------------------------------------------------------------------------ */

static bool is_dark(const lmp_light *light, lmp_vec3 point) {
    float sh[3 * COUNT], most = 0;
    lmp_light_project(BANDS, light, 1, point, sh);
    for (int i = 0; i < 3 * COUNT; i++)
        most = fmaxf(most, fabsf(sh[i]));
    const lmp_rgb e = lmp_light_irradiance(light, 1, point, up);
    return most == 0 && e.r == 0 && e.g == 0 && e.b == 0;
}

static void a_flat_area_shines_to_the_side_of_its_normal(void **state) {
    (void)state;
    for (int k = 0; k < AREA_KINDS; k++) {
        random_area a = area_random(area_kinds[k]);
        if (area_kinds[k] == LMP_LIGHT_TUBE)
            continue;
        const lmp_vec3 front = area_sum(a.light.position, a.size, a.normal),
                       behind = area_sum(a.light.position, -a.size, a.normal);
        a.light.two_sided = false;
        assert_false(is_dark(&a.light, front));
        assert_true(is_dark(&a.light, behind));
        a.light.two_sided = true;
        assert_false(is_dark(&a.light, behind));
    }
}

static void a_flat_area_does_not_light_its_own_plane(void **state) {
    (void)state;
    const lmp_vec3 inside = { 0.25f, -0.5f, 0 }, edge = { 1, 0.5f, 0 }, corner = { 1, 1, 0 },
                   outside = { 3, 0.1f, 0 };
    for (int sides = 0; sides < 2; sides++) {
        const lmp_light light = area_square(sides);
        assert_true(is_dark(&light, origin) && is_dark(&light, inside) && is_dark(&light, edge) &&
                    is_dark(&light, corner) && is_dark(&light, outside));
    }
}

static void touching_it_is_being_under_a_hemisphere(void **state) {
    (void)state;
    const lmp_light light = area_square(true);
    for (int side = -1; side <= 1; side += 2) {
        const lmp_vec3 point = { 0.25f, -0.5f, (float)side * 1e-6f }, away = { 0, 0, (float)-side };
        const lmp_rgb e = lmp_light_irradiance(&light, 1, point, away);
        CHECK_WITHIN(fabs((double)e.r / ORACLE_PI - 1), 1e-5);
    }
}

static void six_rectangles_around_a_point_are_ambient_light(void **state) {
    (void)state;
    const float size[3] = { 1, 2, 0.5f };
    lmp_light box[6];
    for (int i = 0; i < 6; i++) {
        const int axis = i % 3, sign = i < 3 ? 1 : -1;
        float at[3] = { 0 }, x[3] = { 0 }, y[3] = { 0 };
        at[axis] = (float)sign * size[axis];
        x[(axis + 1) % 3] = size[(axis + 1) % 3];
        y[(axis + 2) % 3] = (float)-sign * size[(axis + 2) % 3];
        box[i] = (lmp_light) { .kind = LMP_LIGHT_RECTANGLE,
                               .position = { at[0], at[1], at[2] },
                               .half = { { x[0], x[1], x[2] }, { y[0], y[1], y[2] } },
                               .radiance = { 1, 1, 1 } };
    }
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 point = { 0.99f * (float)check_random_between(-1, 1),
                                 1.99f * (float)check_random_between(-1, 1),
                                 0.49f * (float)check_random_between(-1, 1) };
        float sh[3 * COUNT];
        double expected[COUNT] = { 2 * sqrt(ORACLE_PI) };
        lmp_light_project(BANDS, box, 6, point, sh);
        CHECK_WITHIN(difference(COUNT, expected, sh), 1e-6);
        const lmp_rgb e = lmp_light_irradiance(box, 6, point, check_random_direction());
        CHECK_WITHIN(fabs((double)e.r / ORACLE_PI - 1), 1e-6);
    }
}

/* --- invariance ------------------------------------------------------------------------------- */

static lmp_vec3 scaled(lmp_vec3 v, float factor) {
    return (lmp_vec3) { v.x * factor, v.y * factor, v.z * factor };
}

static void scaling_changes_no_bit(void **state) {
    (void)state;
    const float factors[] = { 0x1p-40f, 0x1p40f };
    for (int k = 0; k < AREA_KINDS; k++)
        for (int i = 0; i < 2; i++) {
            const random_area a = area_random(area_kinds[k]);
            const lmp_vec3 point = area_point(&a);
            float sh[3 * COUNT], other[3 * COUNT];
            lmp_light far = a.light;
            far.position = scaled(far.position, factors[i]);
            far.radius *= factors[i];
            for (int c = 0; c < LMP_LIGHT_CORNERS_MAX; c++)
                far.corner[c] = scaled(far.corner[c], factors[i]);
            lmp_light_project(BANDS, &a.light, 1, point, sh);
            lmp_light_project(BANDS, &far, 1, scaled(point, factors[i]), other);
            assert_memory_equal(sh, other, sizeof sh);
        }
}

static void a_tube_of_no_length_is_a_sphere(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        const double distance = pow(10, check_random_between(-1, 3)), radius = 0.75;
        const lmp_vec3 point = scaled(check_random_direction(), (float)distance);
        lmp_light tube = { .kind = LMP_LIGHT_TUBE, .radius = 0.75f, .radiance = { 1, 1, 1 } };
        const double center[3] = { 0 };
        float sh[3 * COUNT];
        double expected[COUNT], p[3];
        wide(point, p);
        oracle_sphere(BANDS, center, radius, p, expected, NULL);
        lmp_light_project(BANDS, &tube, 1, point, sh);
        CHECK_WITHIN(difference(COUNT, expected, sh), 1e-6);
        tube.half[0] = scaled(check_random_direction(), 1e-7f);
        lmp_light_project(BANDS, &tube, 1, point, sh);
        if (distance > radius + 0.01)
            CHECK_WITHIN(difference(COUNT, expected, sh), 5e-6);
    }
}

static void a_far_disk_is_a_sphere_of_its_projected_area(void **state) {
    (void)state;
    for (int i = 0; i < 50; i++) {
        const lmp_vec3 normal = check_random_direction(),
                       point = scaled(check_random_direction(), 3000);
        const lmp_light disk = { .kind = LMP_LIGHT_DISK,
                                 .direction = normal,
                                 .radius = 1,
                                 .two_sided = true,
                                 .radiance = { 1, 1, 1 } };
        const float cosine =
            fabsf(normal.x * point.x + normal.y * point.y + normal.z * point.z) / 3000;
        const lmp_light sphere = { .radius = sqrtf(cosine), .radiance = { 1, 1, 1 } };
        float sh[3 * COUNT], other[3 * COUNT];
        double expected[COUNT];
        lmp_light_project(BANDS, &disk, 1, point, sh);
        lmp_light_project(BANDS, &sphere, 1, point, other);
        widen(COUNT, other, expected);
        CHECK_WITHIN(difference(COUNT, expected, sh), 1e-5);
    }
}

/* Where an area becomes a point, a little nearer and a little farther, its light times the square
 * of the distance must be the same. */
static void becoming_a_point_does_not_show(void **state) {
    (void)state;
    for (int k = 0; k < AREA_KINDS; k++)
        for (int i = 0; i < 20; i++) {
            random_area a = area_random(area_kinds[k]);
            const lmp_vec3 w = check_random_direction();
            const double square[2] = { 0.99e6, 0.99e6 * 0x1p5 };
            float sh[2][3 * MOST * MOST];
            double expected[MOST * MOST];
            a.light.position = origin;
            a.light.two_sided = true;
            for (int side = 0; side < 2; side++) {
                lmp_light_project(MOST, &a.light, 1, scaled(w, (float)(a.size * square[side])),
                                  sh[side]);
                for (int c = 0; c < MOST * MOST; c++)
                    sh[side][c] *= (float)(a.size * a.size * square[side] * square[side]);
            }
            widen(LMP_SH_COUNT(MOST), sh[0], expected);
            CHECK_WITHIN(difference(LMP_SH_COUNT(MOST), expected, sh[1]), 1e-5);
        }
}

/* The position may be anywhere, and any corner the first: here it is a corner, then the middle. */
static void a_far_polygon_is_a_point_at_its_centroid(void **state) {
    (void)state;
    enum { ALL = LMP_SH_COUNT(LMP_BANDS_MAX) };
    static float sh[3 * ALL], other[3 * ALL];
    static double expected[ALL];
    lmp_light triangle = { .kind = LMP_LIGHT_POLYGON,
                           .corner_count = 3,
                           .corner = { { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 } },
                           .radiance = { 1, 1, 1 } };
    const lmp_vec3 point = { 0, 0, 4e6f };
    lmp_light_project(LMP_BANDS_MAX, &triangle, 1, point, sh);
    triangle.position = (lmp_vec3) { 1, 1, 0 };
    triangle.corner[0] = (lmp_vec3) { 2, -1, 0 };
    triangle.corner[1] = (lmp_vec3) { -1, 2, 0 };
    triangle.corner[2] = (lmp_vec3) { -1, -1, 0 };
    lmp_light_project(LMP_BANDS_MAX, &triangle, 1, point, other);
    widen(ALL, other, expected);
    CHECK_WITHIN(difference(ALL, expected, sh), 1e-7);
}

static void a_tube_is_continuous_at_its_surface_and_ambient_in_its_middle(void **state) {
    (void)state;
    const lmp_light tube = {
        .kind = LMP_LIGHT_TUBE, .half = { { 2, 0, 0 } }, .radius = 1, .radiance = { 1, 1, 1 }
    };
    const lmp_vec3 ways[] = { { 0, 1, 0 }, { 0, 0.6f, 0.8f } };
    float sh[2][3 * COUNT];
    double expected[COUNT];
    for (int i = 0; i < 6; i++) {
        const lmp_vec3 start = { 0.9f * (float)i - 2, 0, 0 };
        for (int side = 0; side < 2; side++)
            lmp_light_project(BANDS, &tube, 1,
                              area_sum(start, side ? 1 + 1e-6 : 1 - 1e-6, ways[i % 2]), sh[side]);
        widen(COUNT, sh[0], expected);
        CHECK_WITHIN(difference(COUNT, expected, sh[1]), 1e-2);
    }
    double ambient[COUNT] = { 2 * sqrt(ORACLE_PI) };
    lmp_light_project(BANDS, &tube, 1, origin, sh[0]);
    CHECK_WITHIN(difference(COUNT, ambient, sh[0]), 1e-6);
}

static void areas_of_no_size_and_points_on_them_are_finite(void **state) {
    (void)state;
    for (int k = 0; k < AREA_KINDS; k++)
        for (int i = 0; i < 3; i++) {
            lmp_light light = { .kind = area_kinds[k],
                                .direction = up,
                                .two_sided = true,
                                .corner_count = 3,
                                .radiance = { 1, 1, 1 } };
            float sh[3 * COUNT];
            if (i > 0)
                light.radius = 1;
            if (i > 1)
                light.half[0] = (lmp_vec3) { 1, 0, 0 };
            const lmp_vec3 points[] = { origin,      up,          { 1, 0, 0 }, { 2, 0, 0 },
                                        { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 1 } };
            for (int p = 0; p < 7; p++) {
                lmp_light_project(BANDS, &light, 1, points[p], sh);
                for (int c = 0; c < 3 * COUNT; c++)
                    CHECK_WITHIN(fabsf(sh[c]), 20);
                CHECK_WITHIN(lmp_light_irradiance(&light, 1, points[p], up).r, 3.15);
            }
        }
}

/* --- many points ------------------------------------------------------------------------------ */

static void many_points_are_each_alone(void **state) {
    (void)state;
    enum { POINTS = 70, LIGHTS = 6 };
    static lmp_vec3 points[POINTS];
    static float visibility[LIGHTS * POINTS], out[POINTS * 3 * COUNT];
    lmp_light lights[LIGHTS] = {
        { .position = { 3, 0, 0 }, .radius = 1, .radiance = { 1, 2, 3 } },
        { .kind = LMP_LIGHT_HEMISPHERE, .direction = up, .radiance = { 1, 1, 1 } }
    };
    for (int i = 0; i < AREA_KINDS; i++)
        lights[2 + i] = area_random(area_kinds[i]).light;
    for (int p = 0; p < POINTS; p++)
        points[p] = scaled(check_random_direction(), 5);
    for (int i = 0; i < LIGHTS * POINTS; i++)
        visibility[i] = (float)check_random();
    const lmp_vec3_array array = { &points->x, &points->y, &points->z, sizeof *points };
    for (int seen = 0; seen < 2; seen++) {
        lmp_light_project_n(NULL, BANDS, lights, LIGHTS, seen ? visibility : NULL, array, POINTS,
                            seen ? lmp_sh_planar(out, 0) : lmp_sh_interleaved(out, 0));
        for (int p = 0; p < POINTS; p++) {
            float sh[3 * COUNT];
            double expected[3 * COUNT] = { 0 };
            for (int i = 0; i < LIGHTS; i++) {
                lmp_light_project(BANDS, &lights[i], 1, points[p], sh);
                for (int c = 0; c < 3 * COUNT; c++)
                    expected[c] += (double)(seen ? visibility[i * POINTS + p] : 1) * (double)sh[c];
            }
            for (int c = 0; c < 3 * COUNT; c++)
                sh[c] = seen ? out[c * POINTS + p] : out[p * 3 * COUNT + c];
            CHECK_WITHIN(difference(3 * COUNT, expected, sh), 3e-6);
        }
    }
}

/* More bands than are summed at once. */
static void ranges_of_bands_are_those_of_all(void **state) {
    (void)state;
    static float sh[3 * MOST * MOST], all[3 * MOST * MOST];
    static double expected[3 * MOST * MOST];
    for (int k = 0; k < AREA_KINDS; k++) {
        const random_area a = area_random(area_kinds[k]);
        const lmp_vec3 point = area_point(&a);
        lmp_light_project(MOST, &a.light, 1, point, all);
        lmp_light_project_n(NULL, MOST, &a.light, 1, NULL, lmp_vec3_array_same(&point), 1,
                            lmp_sh_interleaved(sh, 0));
        widen(3 * LMP_SH_COUNT(MOST), all, expected);
        CHECK_WITHIN(difference(3 * LMP_SH_COUNT(MOST), expected, sh), 2e-7);
    }
}

static void every_instruction_set_gives_the_same_bits(void **state) {
    (void)state;
    enum { POINTS = 20 };
    static lmp_vec3 points[POINTS];
    static float sh[2][POINTS * 3 * COUNT];
    static lmp_rgb rgb[2][POINTS];
    lmp_light lights[1 + AREA_KINDS] = { { .position = { 0, 0, 9 }, .radiance = { 1, 1, 1 } } };
    for (int i = 0; i < AREA_KINDS; i++)
        lights[1 + i] = area_random(area_kinds[i]).light;
    for (int p = 0; p < POINTS; p++)
        points[p] = scaled(check_random_direction(), 5);
    const lmp_material material = { .kind = LMP_MATERIAL_METALLIC_ROUGHNESS, .roughness = 0.5f };
    const lmp_surfaces surfaces = { .position = lmp_vec3_array_of(points),
                                    .normal = lmp_vec3_array_same(&up),
                                    .view = lmp_vec3_array_same(&up),
                                    .material = &material };
    unsigned compared = 0;
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2) {
        if (lmp_cpu_limit(flag) != flag)
            continue;
        const int to = compared++ > 0;
        lmp_light_project_n(NULL, BANDS, lights, 1 + AREA_KINDS, NULL, lmp_vec3_array_of(points),
                            POINTS, lmp_sh_interleaved(sh[to], 0));
        lmp_shade_n(NULL, &surfaces, POINTS, lights, 1 + AREA_KINDS, lmp_rgb_array_of(rgb[to]));
        if (to == 0)
            continue;
        assert_memory_equal(sh[0], sh[1], sizeof *sh);
        assert_memory_equal(rgb[0], rgb[1], sizeof *rgb);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    assert_true(compared > 0);
}

/* --- the rest --------------------------------------------------------------------------------- */

static void beyond_its_range_an_area_gives_no_more(void **state) {
    (void)state;
    for (int i = 0; i < 400; i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const float least = (float)pow(10, check_random_between(-6, 0.6));
        const double range = (double)lmp_light_range(&a.light, least);
        const lmp_vec3 w = check_random_direction(),
                       point = area_sum(a.light.position, range * 1.0001 + 1e-6, w);
        const lmp_rgb e = lmp_light_irradiance(&a.light, 1, point, scaled(w, -1));
        CHECK_WITHIN(e.r, least);
        if (range > 0)
            CHECK_WITHIN(range / a.size, 4 * sqrt(ORACLE_PI / (double)least) + 2);
    }
}

static void power_and_intensity_follow_from_the_surface(void **state) {
    (void)state;
    lmp_light square = area_square(false);
    const lmp_light disk = { .kind = LMP_LIGHT_DISK, .direction = up, .radius = 2 };
    const lmp_light tube = { .kind = LMP_LIGHT_TUBE, .half = { { 3, 0, 0 } }, .radius = 2 };
    const lmp_light triangle = { .kind = LMP_LIGHT_POLYGON,
                                 .corner_count = 3,
                                 .corner = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 } } };
    const struct {
        const lmp_light *light;
        double shining, facing;
    } expected[] = { { &square, 4, 4 },
                     { &disk, 4 * ORACLE_PI, 4 * ORACLE_PI },
                     { &tube, 40 * ORACLE_PI, 24 + 4 * ORACLE_PI },
                     { &triangle, 3, 3 } };
    for (int i = 0; i < 4; i++) {
        const lmp_light *l = expected[i].light;
        const float power = lmp_light_power_from_radiance(l, 5),
                    intensity = lmp_light_intensity_from_radiance(l, 5);
        CHECK_WITHIN(fabs((double)power / (5 * ORACLE_PI * expected[i].shining) - 1), 1e-6);
        CHECK_WITHIN(fabs((double)intensity / (5 * expected[i].facing) - 1), 1e-6);
        CHECK_WITHIN(fabsf(lmp_light_radiance_from_power(l, power) - 5), 2e-6);
        CHECK_WITHIN(fabsf(lmp_light_radiance_from_intensity(l, intensity) - 5), 2e-6);
    }
    square.two_sided = true;
    CHECK_WITHIN(fabs((double)lmp_light_power_from_radiance(&square, 1) / (8 * ORACLE_PI) - 1),
                 1e-6);
}

/* The angles that outlines are summed from, against the C library's, in every quadrant, near the
 * axes and where the sign changes. */
static void angles_are_exact_in_double(void **state) {
    (void)state;
    assert_true(lmpi_angle(0, 0) == 0);
    CHECK_WITHIN(fabs(lmpi_angle(0, -1) - atan2(0, -1)), 1e-15);
    for (int i = 0; i < 100000; i++) {
        const double near = pow(10, check_random_between(-12, 0)), far = 1 - near * near;
        const double x = (i & 1 ? 1 : -1) * (i & 4 ? near : far);
        const double y = (i & 2 ? 1 : -1) * (i & 4 ? far : near);
        const double expected = atan2(y, x);
        CHECK_WITHIN(fabs(lmpi_angle(y, x) - expected), 1e-15 * fabs(expected));
    }
}

static void fields_refuse_areas(void **state) {
    (void)state;
    const lmp_field_desc desc = { .bands = 2, .nodes = { 4, 4, 4 } };
    const lmp_light area = area_square(false), sphere = { .radius = 1, .radiance = { 1, 1, 1 } };
    const lmp_light both[] = { sphere, area };
    lmp_field *field;
    assert_int_equal(lmp_field_create(NULL, &desc, &field), LMP_OK);
    assert_int_equal(lmp_field_update(NULL, field, &sphere, 1), LMP_OK);
    assert_int_equal(lmp_field_update(NULL, field, both, 2), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_field_reset(field, both, 2), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_field_add(NULL, field, &area), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_field_describe(field).light_count, 1);
    lmp_field_destroy(field);
}

/* --- texels ----------------------------------------------------------------------------------- */

static void check_texel(const float texel[4], float x, float y, float z, float w) {
    const float expected[4] = { x, y, z, w };
    for (int c = 0; c < 4; c++)
        CHECK_WITHIN(fabsf(texel[c] - expected[c]), 1e-6);
}

static void texels_say_what_an_area_is(void **state) {
    (void)state;
    float texel[LMP_AREA_TEXELS][4];
    lmp_light light = area_square(true);
    light.position = (lmp_vec3) { 5, 6, 7 };
    lmp_light_copy_area_texels(&light, texel[0]);
    check_texel(texel[0], 5, 6, 7, -4);
    check_texel(texel[1], 1, 2, 3, sqrtf(2));
    check_texel(texel[2], 0, 0, 1, 0);
    check_texel(texel[3], -1, -1, 0, 0);
    check_texel(texel[5], 1, 1, 0, 0);
    check_texel(texel[7], 0, 0, 0, 0);
    light = (lmp_light) { .kind = LMP_LIGHT_DISK, .direction = { 0, 1, 0 }, .radius = 2 };
    lmp_light_copy_area_texels(&light, texel[0]);
    check_texel(texel[0], 0, 0, 0, 1);
    check_texel(texel[1], 0, 0, 0, 2);
    check_texel(texel[2], 0, 1, 0, 2);
    light = (lmp_light) { .kind = LMP_LIGHT_TUBE, .half = { { 0, 3, 0 } }, .radius = 0.5f };
    lmp_light_copy_area_texels(&light, texel[0]);
    check_texel(texel[0], 0, 0, 0, 2);
    check_texel(texel[1], 0, 0, 0, 3.5f);
    check_texel(texel[2], 0, 3, 0, 0.5f);
}

/* Corners far from the position are given from the polygon's middle. */
static void texels_begin_at_the_middle(void **state) {
    (void)state;
    float texel[LMP_AREA_TEXELS][4];
    const lmp_light triangle = { .kind = LMP_LIGHT_POLYGON,
                                 .position = { 1, 0, 0 },
                                 .corner_count = 3,
                                 .corner = { { 99, 0, 0 }, { 102, 0, 0 }, { 99, 3, 0 } } };
    lmp_light_copy_area_texels(&triangle, texel[0]);
    check_texel(texel[0], 101, 1, 0, 3);
    check_texel(texel[2], 0, 0, 1, 0);
    check_texel(texel[3], -1, -1, 0, 0);
    check_texel(texel[4], 2, -1, 0, 0);
    check_texel(texel[5], -1, 2, 0, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coefficients_are_the_integral_over_the_area),
        cmocka_unit_test(lobes_respond_by_the_integral_over_the_area),
        cmocka_unit_test(the_horizon_cuts_the_irradiance),
        cmocka_unit_test(a_flat_area_shines_to_the_side_of_its_normal),
        cmocka_unit_test(a_flat_area_does_not_light_its_own_plane),
        cmocka_unit_test(touching_it_is_being_under_a_hemisphere),
        cmocka_unit_test(six_rectangles_around_a_point_are_ambient_light),
        cmocka_unit_test(scaling_changes_no_bit),
        cmocka_unit_test(a_tube_of_no_length_is_a_sphere),
        cmocka_unit_test(a_far_disk_is_a_sphere_of_its_projected_area),
        cmocka_unit_test(becoming_a_point_does_not_show),
        cmocka_unit_test(a_far_polygon_is_a_point_at_its_centroid),
        cmocka_unit_test(a_tube_is_continuous_at_its_surface_and_ambient_in_its_middle),
        cmocka_unit_test(areas_of_no_size_and_points_on_them_are_finite),
        cmocka_unit_test(many_points_are_each_alone),
        cmocka_unit_test(ranges_of_bands_are_those_of_all),
        cmocka_unit_test(every_instruction_set_gives_the_same_bits),
        cmocka_unit_test(beyond_its_range_an_area_gives_no_more),
        cmocka_unit_test(power_and_intensity_follow_from_the_surface),
        cmocka_unit_test(angles_are_exact_in_double),
        cmocka_unit_test(fields_refuse_areas),
        cmocka_unit_test(texels_say_what_an_area_is),
        cmocka_unit_test(texels_begin_at_the_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
