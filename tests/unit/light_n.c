/* SPDX-License-Identifier: MIT */
/* Lights of any kind at many points: what lmp_light_project returns for each point, alone and
 * mixed, with visibility, and added to what is there. */
#include "tests/oracle/check.h"
#include "tests/oracle/kinds.h"

#include <lampion/cpu.h>
#include <lampion/lampion.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { POINTS = 150, LIGHTS = 75, MOST = 20, VALUES = 3 * MOST * MOST };

static lmp_vec3 points[POINTS];
static lmp_light lights[LIGHTS];
static float visibility[LIGHTS * POINTS];
static float out[POINTS * (VALUES + 8)], other[POINTS * (VALUES + 8)];

/* Fills in lights of every kind, moved and rotated; the first points are where a point light is, on
 * the axis of a spot, and within a sphere. Members that a kind does not name are NaN. */
static int fill(void **test) {
    (void)test;
    for (int i = 0; i < LIGHTS; i++) {
        lmp_light *light = &lights[i];
        const lmp_vec3 moved = check_random_direction();
        *light = one_of_each_kind[i % KINDS];
        light->position.x += 2 * moved.x;
        light->position.z += 2 * moved.z;
        if (i >= KINDS && light->kind != LMP_LIGHT_HEMISPHERE)
            light->direction = check_random_direction();
        if (light->kind != LMP_LIGHT_SPHERE)
            light->radius = NAN;
        if (light->kind > LMP_LIGHT_SPOT)
            light->position = (lmp_vec3) { NAN, NAN, NAN };
    }
    for (int p = 0; p < POINTS; p++)
        points[p] = (lmp_vec3) { (float)check_random_between(-3, 3), (float)check_random(),
                                 (float)check_random_between(-3, 3) };
    const lmp_light *spot = &lights[2];
    points[0] = lights[1].position;
    points[1] =
        (lmp_vec3) { spot->position.x + spot->direction.x, spot->position.y + spot->direction.y,
                     spot->position.z + spot->direction.z };
    points[2] =
        (lmp_vec3) { lights[0].position.x + 0.1f, lights[0].position.y, lights[0].position.z };
    points[3] = lights[0].position;
    points[4] = spot->position;
    for (int i = 0; i < LIGHTS * POINTS; i++)
        visibility[i] = (float)(i * 7919 % 101) / 100;
    return 0;
}

/* Compares relative to the largest value. With few lights and bands the bound is the rounding of a
 * cone that fades, whose slope is 2 / (cos inner - cos outer). */
static void check_same(size_t count, const float *expected, const float *actual) {
    double wide[VALUES];
    for (size_t i = 0; i < count; i++)
        wide[i] = (double)expected[i];
    CHECK_WITHIN(check_error(count, wide, actual), 1e-5);
}

/* Expects the sum of every light by itself, times its visibility; with 1 that is the sum of all at
 * once, up to rounding. */
static void expect(int bands, const lmp_light *of, size_t count, const float *visible,
                   size_t stride, lmp_vec3 point, float *sh) {
    const size_t values = 3 * LMP_SH_COUNT(bands);
    float one[VALUES];
    double sums[VALUES] = { 0 };
    for (size_t i = 0; i < count; i++) {
        lmp_light_project(bands, &of[i], 1, point, one);
        for (size_t v = 0; v < values; v++)
            sums[v] += (double)one[v] * (double)(visible ? visible[i * stride] : 1);
    }
    for (size_t v = 0; v < values; v++)
        sh[v] = (float)sums[v];
}

/* Checks both layouts, with any stride; what lies between is left alone. */
static void check_all(int bands, const lmp_light *of, size_t count, const float *visible,
                      size_t point_count) {
    const size_t values = 3 * LMP_SH_COUNT(bands), row = values + 3, plane = point_count + 5;
    float expected[VALUES], actual[VALUES];
    for (size_t i = 0; i < sizeof out / sizeof *out; i++)
        out[i] = other[i] = -77;
    lmp_light_project_n(NULL, bands, of, count, visible, lmp_vec3_array_of(points), point_count,
                        lmp_sh_interleaved(out, row * sizeof(float)));
    lmp_light_project_n(NULL, bands, of, count, visible, lmp_vec3_array_of(points), point_count,
                        lmp_sh_planar(other, plane * sizeof(float)));
    for (size_t p = 0; p < point_count; p++) {
        expect(bands, of, count, visible ? visible + p : NULL, point_count, points[p], expected);
        check_same(values, expected, out + p * row);
        for (size_t v = 0; v < values; v++)
            actual[v] = other[v * plane + p];
        assert_memory_equal(actual, out + p * row, values * sizeof *actual);
        for (size_t gap = values; gap < row; gap++)
            assert_true(out[p * row + gap] == -77);
    }
    for (size_t v = 0; v < values; v++)
        for (size_t gap = point_count; gap < plane; gap++)
            assert_true(other[v * plane + gap] == -77);
    assert_true(other[values * plane] == -77);
}

static void each_kind_alone_is_its_projection(void **test) {
    (void)test;
    for (int kind = 0; kind < KINDS; kind++)
        for (int bands = 1; bands <= MOST; bands++)
            for (size_t count = 1; count <= 21; count += 4)
                check_all(bands, &lights[kind], 1, NULL, count);
}

static void mixed_kinds_are_the_sum_of_their_projections(void **test) {
    (void)test;
    for (int bands = 1; bands <= MOST; bands++)
        for (size_t count = 2; count <= LIGHTS; count += bands % 4 == 2 ? 9 : 31) {
            check_all(bands, lights, count, NULL, 1 + count % 5);
            check_all(bands, lights, count, NULL, 17 + count % 19);
        }
    check_all(6, lights, LIGHTS, NULL, POINTS);
}

static void visibility_weighs_lights_of_every_kind(void **test) {
    (void)test;
    static const int bands[] = { 1, 4, 9, 20 };
    for (int b = 0; b < 4; b++) {
        check_all(bands[b], lights, LIGHTS, visibility, 3);
        check_all(bands[b], lights, LIGHTS, visibility, 37);
    }
    check_all(6, lights, LIGHTS, visibility, POINTS);
    for (int i = 0; i < LIGHTS * POINTS; i++)
        visibility[i] = 1;
    lmp_light_project_n(NULL, 6, lights, LIGHTS, visibility, lmp_vec3_array_of(points), POINTS,
                        lmp_sh_interleaved(out, 0));
    lmp_light_project_n(NULL, 6, lights, LIGHTS, NULL, lmp_vec3_array_of(points), POINTS,
                        lmp_sh_interleaved(other, 0));
    assert_memory_equal(out, other, POINTS * 3 * 36 * sizeof *out);
    fill(NULL);
}

static void no_lights_are_dark_and_no_points_are_nothing(void **test) {
    (void)test;
    for (size_t i = 0; i < sizeof out / sizeof *out; i++)
        out[i] = -77;
    lmp_light_project_n(NULL, 5, NULL, 0, NULL, lmp_vec3_array_of(points), 3,
                        lmp_sh_interleaved(out, 0));
    for (int i = 0; i < 4 * 75; i++)
        assert_true(out[i] == (i < 3 * 75 ? 0 : -77));
    lmp_light_project_n(NULL, 5, lights, LIGHTS, NULL, lmp_vec3_array_of(NULL), 0,
                        lmp_sh_planar(out + 4 * 75, 0));
    lmp_light_add_n(NULL, 5, NULL, 0, NULL, lmp_vec3_array_of(points), 3,
                    lmp_sh_planar(out + 4 * 75, 0));
    for (size_t i = 4 * 75; i < sizeof out / sizeof *out; i++)
        assert_true(out[i] == -77);
}

static void spheres_alone_have_the_bits_of_their_own_function(void **test) {
    (void)test;
    static lmp_light spheres[LIGHTS];
    for (int i = 0; i < LIGHTS; i++) {
        spheres[i] = lights[i / KINDS * KINDS];
        spheres[i].radius = 0.01f * (float)i;
    }
    const lmp_spheres same = lmp_spheres_of(spheres);
    const lmp_vec3_array at = lmp_vec3_array_of(points);
    for (size_t count = 1; count <= POINTS; count += 149) {
        lmp_light_project_n(NULL, 7, spheres, LIGHTS, visibility, at, count, lmp_sh_planar(out, 0));
        lmp_sphere_sum_n(NULL, 7, &same, LIGHTS, visibility, at, count, lmp_sh_planar(other, 0));
        assert_memory_equal(out, other, count * 147 * sizeof *out);
    }
}

/* Sums lights, and adds them to what is there, for as many points and bands. */
static void sum_twice(int bands, size_t light_count, const float *visible, size_t first,
                      size_t count, float *sh) {
    const lmp_vec3_array at = lmp_vec3_array_of(points + first);
    lmp_light_project_n(NULL, bands, lights, light_count, visible, at, count,
                        lmp_sh_interleaved(sh, 0));
    lmp_light_add_n(NULL, bands, lights + 3, light_count - 3, visible, at, count,
                    lmp_sh_interleaved(sh, 0));
}

static void neither_a_split_nor_an_instruction_set_changes_a_bit(void **test) {
    (void)test;
    static const int bands[] = { 1, 3, 6, 10, 20 };
    for (unsigned flag = LMP_CPU_SCALAR; flag <= lmp_cpu_flags(); flag *= 2)
        for (int b = 0; b < 5 && lmp_cpu_limit(flag) == flag; b++) {
            const size_t values = 3 * LMP_SH_COUNT(bands[b]);
            lmp_cpu_limit(LMP_CPU_SCALAR);
            sum_twice(bands[b], LIGHTS, NULL, 0, POINTS, out);
            lmp_cpu_limit(flag);
            for (size_t first = 0, n = 1; first < POINTS; first += n, n += 1 + n / 2) {
                n = n < POINTS - first ? n : POINTS - first;
                sum_twice(bands[b], LIGHTS, NULL, first, n, other + first * values);
            }
            assert_memory_equal(out, other, POINTS * values * sizeof *out);
        }
    lmp_cpu_limit(LMP_CPU_ALL);
}

static void added_lights_are_those_of_a_sum(void **test) {
    (void)test;
    for (int bands = 1; bands <= MOST; bands += 3)
        for (size_t count = 1; count < 100; count += count < 4 ? 1 : 41) {
            const size_t values = 3 * LMP_SH_COUNT(bands);
            const lmp_vec3_array at = lmp_vec3_array_of(points);
            float before[VALUES], after[VALUES], sum[VALUES];
            lmp_light_project_n(NULL, bands, lights, 40, visibility, at, count,
                                lmp_sh_planar(out, 0));
            lmp_light_add_n(NULL, bands, lights + 40, LIGHTS - 40, visibility + 40 * count, at,
                            count, lmp_sh_planar(out, 0));
            for (size_t p = 0; p < count; p++) {
                expect(bands, lights, 40, visibility + p, count, points[p], before);
                expect(bands, lights + 40, LIGHTS - 40, visibility + 40 * count + p, count,
                       points[p], after);
                for (size_t v = 0; v < values; v++) {
                    before[v] += after[v];
                    sum[v] = out[v * count + p];
                }
                check_same(values, before, sum);
            }
        }
}

/* The bound is that of light.h: each addition rounds once, and what it adds is the same each time.
 */
static void a_light_taken_away_leaves_rounding_alone(void **test) {
    (void)test;
    enum { TIMES = 1000, BANDS = 5, N = 3 * BANDS * BANDS };
    const lmp_vec3_array at = lmp_vec3_array_of(points + 5);
    lmp_light_project_n(NULL, BANDS, lights, KINDS, NULL, at, 1, lmp_sh_interleaved(other, 0));
    for (int kind = 0; kind < KINDS; kind++) {
        lmp_light negative = lights[kind];
        negative.radiance =
            (lmp_rgb) { -negative.radiance.r, -negative.radiance.g, -negative.radiance.b };
        negative.ground = (lmp_rgb) { -negative.ground.r, -negative.ground.g, -negative.ground.b };
        float most = 0;
        memcpy(out, other, N * sizeof *out);
        for (int i = 0; i < TIMES; i++) {
            lmp_light_add_n(NULL, BANDS, &lights[kind], 1, NULL, at, 1, lmp_sh_interleaved(out, 0));
            for (int v = 0; v < N; v++)
                most = fmaxf(most, fabsf(out[v]));
            lmp_light_add_n(NULL, BANDS, &negative, 1, NULL, at, 1, lmp_sh_interleaved(out, 0));
        }
        for (int v = 0; v < N; v++)
            CHECK_WITHIN(fabsf(out[v] - other[v]), TIMES * 0x1p-23f * most);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_kind_alone_is_its_projection),
        cmocka_unit_test(mixed_kinds_are_the_sum_of_their_projections),
        cmocka_unit_test(visibility_weighs_lights_of_every_kind),
        cmocka_unit_test(no_lights_are_dark_and_no_points_are_nothing),
        cmocka_unit_test(spheres_alone_have_the_bits_of_their_own_function),
        cmocka_unit_test(neither_a_split_nor_an_instruction_set_changes_a_bit),
        cmocka_unit_test(added_lights_are_those_of_a_sum),
        cmocka_unit_test(a_light_taken_away_leaves_rounding_alone),
    };
    return cmocka_run_group_tests(tests, fill, NULL);
}
