/* SPDX-License-Identifier: MIT */
/* Lights of a field that move, appear and disappear, against the same lights given at once; and
 * changes that must not change the bits. */
#include "tests/unit/fields.h"

#include <lampion/cpu.h>

#include <string.h>

enum { LIGHTS = 40, POINTS = 60 };

static const lmp_field_desc grid = {
    .bands = 4, .nodes = { 9, 7, 10 }, .light_max = LIGHTS, .reach = 2
};
/* A field with so many nodes that it has a coarser one, which has a coarser one, too. */
static const lmp_field_desc deep = { .bands = 4,
                                     .nodes = { 30, 16, 30 },
                                     .cell = { 0.3f, 0.4f, 0.3f },
                                     .light_max = LIGHTS,
                                     .reach = 2 };
enum { VALUES = 3 * 4 * 4 };

/* Returns the largest difference of coefficients, relative to the largest. */
static double difference(const lmp_field *a, const lmp_field *b) {
    double worst = 0;
    for (int i = 0; i < POINTS; i++) {
        const lmp_vec3 point = field_point(0, 6);
        float of_a[VALUES], of_b[VALUES];
        lmp_field_eval_n(a, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(of_a, 0));
        lmp_field_eval_n(b, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(of_b, 0));
        worst = fmax(worst, field_distance(of_a, of_b, VALUES) / (field_size(of_b, VALUES) + 1e-9));
    }
    return worst;
}

static lmp_field *same_lights(const lmp_field *field) {
    const lmp_field_info info = lmp_field_describe(field);
    return field_of(&info.desc, lmp_field_lights(field), info.light_count);
}

static void change_lights(const lmp_field_desc *desc) {
    lmp_light lights[LIGHTS];
    field_sphere_lights(-2, 9, LIGHTS, lights);
    lmp_field *field = field_of(desc, lights, LIGHTS / 2);
    for (size_t i = LIGHTS / 2; i < LIGHTS; i++)
        assert_int_equal(lmp_field_add(NULL, field, &lights[i]), LMP_OK);
    assert_int_equal(lmp_field_add(NULL, field, &lights[0]), LMP_ERROR_ARGUMENT);
    for (int step = 0; step < 30; step++) {
        const size_t at[3] = { (size_t)(step % 9), (size_t)(step % 13 + 10), (size_t)(25) };
        lmp_light moved[3];
        field_sphere_lights(-2, 9, 3, moved);
        moved[2].kind = step % 2 ? LMP_LIGHT_POINT : LMP_LIGHT_SPHERE;
        moved[1].radius = step % 3 ? 0.1f : 20; /* too large for a list */
        lmp_field_move_n(NULL, field, at, moved, 3);
        for (int k = 0; k < 3; k++)
            lights[at[k]] = moved[k];
    }
    assert_memory_equal(lights, lmp_field_lights(field), sizeof lights);
    lmp_field *recomputed = same_lights(field);
    CHECK_WITHIN(difference(field, recomputed), 2e-5);
    lmp_field_destroy(recomputed);
    for (size_t left = LIGHTS; left > 0; left--) {
        const size_t gone = left * 7 % left;
        lights[gone] = lights[left - 1];
        lmp_field_remove(NULL, field, gone);
        assert_int_equal(lmp_field_describe(field).light_count, left - 1);
        assert_memory_equal(lights, lmp_field_lights(field), (left - 1) * sizeof *lights);
    }
    const lmp_vec3 point = { 3, 3, 3 };
    float dark[VALUES];
    lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(dark, 0));
    CHECK_WITHIN(field_size(dark, VALUES), 1e-4);
    lmp_field_destroy(field);
}

static void lights_that_move_come_and_go_leave_what_is_left(void **test) {
    (void)test;
    change_lights(&grid);
    change_lights(&deep);
}

/* The long form makes 10^6 changes. The bound is that of field.h, for as many changes as pass until
 * a node is recomputed; sums drift by far less. */
static void rounding_does_not_add_up(void **test) {
    (void)test;
    const int changes = check_count(20000, 1000000);
    const lmp_field_desc desc = { .bands = 4, .nodes = { 5, 5, 5 }, .reach = 1 };
    const size_t passed = 2 * 3 * 3 * LMP_FIELD_REFRESH; /* bricks times the refresh interval */
    lmp_light lights[LIGHTS];
    field_sphere_lights(-1, 5, LIGHTS, lights);
    lmp_field *field = field_of(&desc, lights, LIGHTS);
    for (int i = 0; i < changes; i++) {
        const size_t at = (size_t)i % LIGHTS;
        lights[at] = field_sphere_light(-1, 5);
        lmp_field_move_n(NULL, field, &at, &lights[at], 1);
    }
    lmp_field *recomputed = same_lights(field);
    const double drift = difference(field, recomputed);
    printf("%d changes: %.1e\n", changes, drift);
    CHECK_WITHIN(drift, 2 * (double)passed / (1 << 24) * 4);
    CHECK_WITHIN(drift, 3e-6);
    lmp_field_destroy(recomputed);
    lmp_field_destroy(field);
}

static void fill_bytes(const lmp_field *field, unsigned char **bytes, size_t *size) {
    *size = lmp_field_size(field);
    *bytes = malloc(*size);
    assert_non_null(*bytes);
    lmp_field_write(field, lmp_field_size(field), *bytes);
}

/* Computes a field after an update and moves: its bytes, and responses of lobes. */
static void field_after_changes(const lmp_host *host, const lmp_field_desc *desc,
                                unsigned char **bytes, size_t *size, lmp_rgb *rgb) {
    lmp_light lights[LIGHTS];
    lmp_vec3 points[POINTS], axes[POINTS];
    float lambda[4];
    for (int i = 0; i < LIGHTS; i++) {
        const float s = (float)i / LIGHTS;
        lights[i] = (lmp_light) { .position = { 8 * s, 6 * s * s, 9 - 8 * s },
                                  .radius = 0.1f + 0.2f * s,
                                  .radiance = { 1 + s, 2 - s, 1 } };
    }
    for (int i = 0; i < POINTS; i++) {
        const float s = (float)i / POINTS;
        points[i] = (lmp_vec3) { 7 * s, 5.5f - 5 * s, 2 + 6 * s };
        axes[i] = (lmp_vec3) { 0.6f, 0, 0.8f };
    }
    lmp_field *field;
    assert_int_equal(lmp_field_create(NULL, desc, &field), LMP_OK);
    assert_int_equal(lmp_field_update(host, field, lights, LIGHTS), LMP_OK);
    const size_t at[2] = { 3, 17 };
    lmp_field_move_n(host, field, at, lights, 2);
    lmp_field_remove(host, field, 5);
    lmp_lobe_make_diffuse(4, lambda);
    lmp_field_eval_lobe_n(field, lambda, lmp_vec3_array_of(axes), lmp_vec3_array_of(points), POINTS,
                          lmp_rgb_array_of(rgb));
    fill_bytes(field, bytes, size);
    lmp_field_destroy(field);
}

static void check_same_bits(const lmp_field_desc *desc) {
    unsigned char *plain, *other;
    size_t size, other_size;
    lmp_rgb rgb[POINTS], other_rgb[POINTS];
    lmp_cpu_limit(LMP_CPU_ALL);
    field_after_changes(NULL, desc, &plain, &size, rgb);
    for (unsigned flag = 0; flag <= LMP_CPU_AVX512; flag = flag ? 2 * flag : LMP_CPU_SCALAR) {
        check_hooks hooks = { .refuse = -1 };
        const lmp_host host = check_host(&hooks);
        if (flag)
            lmp_cpu_limit(flag);
        field_after_changes(&host, desc, &other, &other_size, other_rgb);
        assert_int_equal(size, other_size);
        assert_memory_equal(plain, other, size);
        assert_memory_equal(rgb, other_rgb, sizeof rgb);
        assert_true(hooks.tasks > 0);
        free(other);
    }
    lmp_cpu_limit(LMP_CPU_ALL);
    free(plain);
}

static void tasks_in_any_order_and_every_instruction_set_give_the_same_bits(void **test) {
    (void)test;
    check_same_bits(&grid);
    check_same_bits(&deep);
}

static void nothing_is_allocated_once_it_is_made(void **test) {
    (void)test;
    check_hooks hooks = { .refuse = -1 };
    const lmp_host host = check_host(&hooks);
    lmp_light lights[LIGHTS];
    lmp_field *field;
    field_sphere_lights(0, 8, LIGHTS, lights);
    assert_int_equal(lmp_field_create(&host, &grid, &field), LMP_OK);
    assert_int_equal(hooks.requests, 1);
    assert_int_equal(lmp_field_update(&host, field, lights, LIGHTS), LMP_OK);
    assert_int_equal(lmp_field_update(&host, field, lights, LIGHTS + 1), LMP_ERROR_ARGUMENT);
    const size_t at = 1;
    lmp_field_move_n(&host, field, &at, lights, 1);
    lmp_field_remove(&host, field, 0);
    assert_int_equal(hooks.requests, 1);
    lmp_field_destroy(field);
    assert_int_equal(hooks.live, 0);
}

static void what_cannot_be_made_is_refused(void **test) {
    (void)test;
    const lmp_field_desc wrong[] = {
        { .bands = -1 },
        { .bands = LMP_FIELD_BANDS_MAX + 1 },
        { .nodes = { 1, 4, 4 } },
        { .nodes = { 4, LMP_FIELD_NODES_MAX + 1, 4 } },
        { .nodes = { 1024, 1024, 1024 } },
        { .nodes = { 4, 1, 4 } },
        { .nodes = { 4, 4, 1 } },
        { .nodes = { LMP_FIELD_NODES_MAX + 1, 4, 4 } },
        { .nodes = { 4, 4, LMP_FIELD_NODES_MAX + 1 } },
        { .cell = { 1, 0, 1 } },
        { .cell = { 0, 1, 1 } },
        { .cell = { 1, 1, 0 } },
        { .cell = { 1.01e12f, 1, 1 } },
        { .cell = { 1, 1.01e12f, 1 } },
        { .cell = { 1, 1, 1.01e12f } },
        { .cell = { 0.99e-12f, 1, 1 } },
        { .cell = { 1, 0.99e-12f, 1 } },
        { .cell = { 1, 1, 0.99e-12f } },
        { .cell = { 1, -1, 1 } },
        { .cell = { NAN, 1, 1 } },
        { .origin = { INFINITY, 0, 0 } },
        { .origin = { 1.01e15f, 0, 0 } },
        { .origin = { 0, -1.01e15f, 0 } },
        { .origin = { 0, 0, 1.01e15f } },
        { .light_max = SIZE_MAX },
        { .light_max = LMP_FIELD_LIGHTS_MAX + 1 },
        { .error = -1 },
        { .error = 2 },
        { .error = NAN },
        { .reach = 0.5f },
        { .reach = 100 },
        { .reach = NAN },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        lmp_field *field = (lmp_field *)1;
        assert_int_equal(lmp_field_create(NULL, &wrong[i], &field), LMP_ERROR_ARGUMENT);
        assert_null(field);
    }
    const lmp_field_desc extreme[] = {
        { .bands = 1, .nodes = { 2, 2, 2 }, .origin = { 1e15f, 1e15f, 1e15f } },
        { .nodes = { 2, 2, 2 }, .origin = { -1e15f, -1e15f, -1e15f }, .light_max = 1, .error = 1 },
        { .nodes = { 2, 2, LMP_FIELD_NODES_MAX }, .cell = { 1e12f, 1e-12f, 1 }, .error = 1e-5f },
        { .bands = LMP_FIELD_BANDS_MAX, .nodes = { 2, 2, 2 }, .reach = 1 },
        { .nodes = { 2, 2, 2 }, .cell = { 1, 1e12f, 1e-12f }, .reach = 64 },
        { .nodes = { 2, 2, 2 }, .light_max = LMP_FIELD_LIGHTS_MAX },
    };
    for (size_t i = 0; i < sizeof extreme / sizeof *extreme; i++)
        lmp_field_destroy(field_of(&extreme[i], NULL, 0));
    check_hooks hooks = { .refuse = 0 };
    const lmp_host host = check_host(&hooks);
    lmp_field *field = (lmp_field *)1;
    assert_int_equal(lmp_field_create(&host, NULL, &field), LMP_ERROR_MEMORY);
    assert_null(field);
    lmp_field_destroy(NULL);
}

static void nodes_are_computed_where_they_are_wanted(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    const size_t first = 3;
    const lmp_vec3 here = { 1.2f, 1.3f, 1.4f }, there = { 6.5f, 4.5f, 7.5f };
    const lmp_vec3_array at_here = lmp_vec3_array_same(&here);
    const lmp_vec3_array at_there = lmp_vec3_array_same(&there);
    float a[VALUES], b[VALUES];
    field_sphere_lights(0, 8, LIGHTS, lights);
    lmp_field *field = field_of(&grid, NULL, 0);
    assert_int_equal(lmp_field_reset(field, lights, LIGHTS), LMP_OK);
    lmp_field_want_n(field, at_here, 1);
    assert_int_equal(lmp_field_compute(NULL, field), LMP_OK);
    lmp_field *whole = same_lights(field);
    lmp_field_eval_n(field, at_here, 1, lmp_sh_interleaved(a, 0));
    lmp_field_eval_n(whole, at_here, 1, lmp_sh_interleaved(b, 0));
    assert_memory_equal(a, b, sizeof a);
    /* what is far from all wanted points has not been computed */
    lmp_field_eval_n(field, at_there, 1, lmp_sh_interleaved(a, 0));
    lmp_field_eval_n(whole, at_there, 1, lmp_sh_interleaved(b, 0));
    assert_true(field_distance(a, b, VALUES) > 0.1 * field_size(b, VALUES));
    /* a moved light counts at nodes computed before and at those computed later */
    lmp_field_move_n(NULL, field, &first, &lights[5], 1);
    lmp_field_move_n(NULL, whole, &first, &lights[5], 1);
    lmp_field_want_n(field, at_there, 1);
    assert_int_equal(lmp_field_compute(NULL, field), LMP_OK);
    lmp_field *moved = same_lights(field);
    lmp_field_eval_n(field, at_there, 1, lmp_sh_interleaved(a, 0));
    lmp_field_eval_n(moved, at_there, 1, lmp_sh_interleaved(b, 0));
    assert_memory_equal(a, b, sizeof a);
    lmp_field_eval_n(field, at_here, 1, lmp_sh_interleaved(a, 0));
    lmp_field_eval_n(whole, at_here, 1, lmp_sh_interleaved(b, 0));
    assert_memory_equal(a, b, sizeof a);
    assert_int_equal(lmp_field_reset(field, lights, LIGHTS + 1), LMP_ERROR_ARGUMENT);
    lmp_field_destroy(moved);
    lmp_field_destroy(whole);
    lmp_field_destroy(field);
}

static void an_update_can_be_cancelled(void **test) {
    (void)test;
    lmp_light lights[LIGHTS];
    lmp_field *field = field_of(&grid, NULL, 0);
    field_sphere_lights(0, 8, LIGHTS, lights);
    check_hooks hooks = { .refuse = -1, .cancel = 3 };
    const lmp_host host = check_host(&hooks);
    assert_int_equal(lmp_field_update(&host, field, lights, LIGHTS), LMP_ERROR_CANCELLED);
    assert_int_equal(lmp_field_update(NULL, field, lights, LIGHTS), LMP_OK);
    lmp_field *recomputed = same_lights(field);
    CHECK_WITHIN(difference(field, recomputed), 0);
    lmp_field_destroy(recomputed);
    lmp_field_destroy(field);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lights_that_move_come_and_go_leave_what_is_left),
        cmocka_unit_test(rounding_does_not_add_up),
        cmocka_unit_test(tasks_in_any_order_and_every_instruction_set_give_the_same_bits),
        cmocka_unit_test(nothing_is_allocated_once_it_is_made),
        cmocka_unit_test(what_cannot_be_made_is_refused),
        cmocka_unit_test(nodes_are_computed_where_they_are_wanted),
        cmocka_unit_test(an_update_can_be_cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
