/* SPDX-License-Identifier: MIT */
/* Lights that are areas, as rays meet them: where a ray hits one, and what rays of shadows bring.
 */
#include "tests/oracle/areas.h"
#include "app/render/shadow/area.h"
#include "app/scene/vector.h"

#include <math.h>

static double dot(lmp_vec3 a, lmp_vec3 b) {
    return (double)a.x * (double)b.x + (double)a.y * (double)b.y + (double)a.z * (double)b.z;
}

/* Returns a point a few sizes from the light, rarely closer. */
static lmp_vec3 point_near(const random_area *a) {
    const double distance = a->size * check_random_between(2, 5);
    return area_sum(a->light.position, distance, check_random_direction());
}

/* --- where a ray hits ------------------------------------------------------------------------- */

/* Returns a point's distance from the axis of a tube. */
static double off_axis(const lmp_light *tube, lmp_vec3 point) {
    const lmp_vec3 to = vec_sub(point, tube->position), half = tube->half[0];
    const double along = fmax(-1, fmin(dot(to, half) / dot(half, half), 1));
    const lmp_vec3 off = area_sum(to, -along, half);
    return sqrt(dot(off, off));
}

static double hit(const scene_emitter *area, lmp_vec3 from, lmp_vec3 direction) {
    const float origin[3] = { from.x, from.y, from.z };
    const float along[3] = { direction.x, direction.y, direction.z };
    return (double)scene_emitter_distance(area, origin, along);
}

/* A ray toward a point of a flat area ends there, or nowhere from behind. One toward a point of a
 * tube's axis ends at the tube's radius from the axis, on the near side. */
static void rays_end_on_the_area(void **state) {
    (void)state;
    for (int i = 0; i < 4000; i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const lmp_vec3 from = point_near(&a), way = vec_sub(a.on, from);
        scene_emitter area;
        scene_emitter_set(&a.light, &area);
        const double found = hit(&area, from, way), length = sqrt(dot(way, way));
        const double height = dot(way, a.normal) / length;
        const bool before = height < 0;
        if (a.light.kind == LMP_LIGHT_TUBE) {
            const lmp_vec3 at = area_sum(from, found, way);
            CHECK_WITHIN(fabs(off_axis(&a.light, at) - (double)a.light.radius), 1e-5 * length);
            assert_true(found > 0 && found <= 1);
        } else if (fabs(height) < 1e-2)
            continue; /* nearly in its plane, rounding moves the point far */
        else if (a.light.two_sided || before)
            CHECK_WITHIN(fabs(found - 1), 1e-4);
        else
            assert_true(isnan(found));
    }
}

/* Returns a direction that passes the light by: its sphere lies to one side. */
static lmp_vec3 way_past(const random_area *a, lmp_vec3 from) {
    const lmp_vec3 to = vec_sub(a->light.position, from);
    const lmp_vec3 aside = vec_across(vec_normalize(to, vec(0, 0, 1)));
    return area_sum(to, 1.5 * a->size + (double)a->light.radius, aside);
}

static void rays_past_the_area_hit_nothing(void **state) {
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const double distance = 40 * a.size;
        const lmp_vec3 from = area_sum(a.light.position, distance, check_random_direction());
        scene_emitter area;
        scene_emitter_set(&a.light, &area);
        assert_true(isnan(hit(&area, from, way_past(&a, from))));
        assert_true(isnan(hit(&area, from, vec_sub(from, a.light.position))));
    }
}

/* From the notch of an arrow one looks through it, beside the notch at it. */
static void a_polygon_may_have_a_notch(void **state) {
    (void)state;
    const lmp_light arrow = { .kind = LMP_LIGHT_POLYGON,
                              .corner_count = 4,
                              .corner = { { 0, 0, 0 }, { 2, -1, 0 }, { 1, 0, 0 }, { 2, 1, 0 } } };
    static const struct {
        float x, y;
        bool covered;
    } cases[] = { { 0.5f, 0, true },     { 1.5f, 0, false },    { 1.5f, 0.6f, true },
                  { 1.5f, -0.6f, true }, { 1.9f, 0.1f, false }, { 0.1f, 0.5f, false } };
    scene_emitter area;
    scene_emitter_set(&arrow, &area);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double found = hit(&area, vec(cases[i].x, cases[i].y, 3), vec(0, 0, -1));
        assert_int_equal(!isnan(found), cases[i].covered);
    }
}

/* --- rays of shadows -------------------------------------------------------------------------- */

enum { STEPS = 96 };

/* Returns the mean of what rays bring to a surface, for an even grid of their numbers. */
static double mean_irradiance(const scene_emitter *area, lmp_vec3 from, lmp_vec3 normal) {
    double sum = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const float u = ((float)(i / STEPS) + 0.5f) / STEPS,
                    v = ((float)(i % STEPS) + 0.5f) / STEPS;
        const shadow_area_sample drawn = shadow_area_draw(area, from, u, v);
        CHECK_WITHIN(fabs(dot(drawn.direction, drawn.direction) - 1), 1e-5);
        sum += (double)drawn.solid_angle * fmax(dot(drawn.direction, normal), 0);
    }
    return sum / (STEPS * STEPS);
}

static double true_irradiance(const lmp_light *light, lmp_vec3 from, lmp_vec3 normal) {
    const double point[3] = { (double)from.x, (double)from.y, (double)from.z };
    const double n[3] = { (double)normal.x, (double)normal.y, (double)normal.z };
    return oracle_area_irradiance(light, point, n);
}

/* The estimate by which lights are chosen is 0 only where nothing arrives. */
static void rays_to_an_area_bring_its_irradiance(void **state) {
    (void)state;
    for (int i = 0; i < check_count(80, 800); i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const lmp_vec3 from = point_near(&a), to = vec_sub(a.light.position, from);
        const lmp_vec3 facing = vec_normalize(to, vec(0, 0, 1));
        const lmp_vec3 normal = i % 3 ? facing : check_random_direction();
        scene_emitter area;
        scene_emitter_set(&a.light, &area);
        const double exact = true_irradiance(&a.light, from, normal),
                     most = true_irradiance(&a.light, from, facing);
        CHECK_WITHIN(fabs(mean_irradiance(&area, from, normal) - exact), 2e-2 * most);
        if (most > 0)
            assert_true(shadow_area_power(&area, vec_sub(area.center, from)) > 0);
    }
}

/* Rays end on the area, but for a ten-thousandth of the way: there the mesh may begin that the
 * light stands for. */
static void rays_to_an_area_end_before_it(void **state) {
    (void)state;
    for (int i = 0; i < 4000; i++) {
        const random_area a = area_random(area_kinds[i % AREA_KINDS]);
        const lmp_vec3 from = point_near(&a);
        scene_emitter area;
        scene_emitter_set(&a.light, &area);
        const shadow_area_sample drawn =
            shadow_area_draw(&area, from, (float)check_random(), (float)check_random());
        const double length = (double)drawn.length;
        const lmp_vec3 end = area_sum(from, length / (1 - 1e-4), drawn.direction);
        if (a.light.kind == LMP_LIGHT_TUBE)
            CHECK_WITHIN(fabs(off_axis(&a.light, end) - (double)a.light.radius), 1e-5 * length);
        else
            CHECK_WITHIN(fabs(dot(vec_sub(end, a.light.position), a.normal)), 1e-5 * length);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_end_on_the_area),
        cmocka_unit_test(rays_past_the_area_hit_nothing),
        cmocka_unit_test(a_polygon_may_have_a_notch),
        cmocka_unit_test(rays_to_an_area_bring_its_irradiance),
        cmocka_unit_test(rays_to_an_area_end_before_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
