/* SPDX-License-Identifier: MIT */
/* Later samples of a pixel reuse from the first one what maps show, where they see the same surface
 * and the image is even around the pixel, and nothing else. */
#include "app/render/cpu/shared.h"

#include "tests/oracle/check.h"

#include <math.h>

enum { SIDE = 3, PIXELS = SIDE * SIDE, MIDDLE = 4, MATERIAL = 7 };

static const render_rectangle whole = { 0, 0, SIDE, SIDE };
static const lmp_vec3 normal = { 0.6f, 0, 0.8f };

/* Two samples of a wall at distance 1 whose base color is 0.5, in an image of 200 rows. */
typedef struct samples {
    render_surfaces first, later;
    float rgba[4 * PIXELS];
} samples;

static void setup(samples *s) {
    static const render_materials plain = { .of = NULL };
    render_surfaces *const both[] = { &s->first, &s->later };
    for (int k = 0; k < 2; k++) {
        assert_true(render_surfaces_create(SIDE, SIDE, &plain, both[k]));
        both[k]->camera = (render_camera) { .down = { 0, 1, 0 }, .step = { 0.01f, 0.01f } };
    }
    assert_true(render_surfaces_keep_smooth(&s->first));
    for (size_t i = 0; i < PIXELS; i++) {
        s->first.seen[i] = MATERIAL;
        s->first.position[0][i] = s->first.position[1][i] = 0;
        s->first.position[2][i] = 1;
        for (int c = 0; c < 3; c++) {
            s->first.normal[c][i] = s->first.emission[c][i] = 0.25f;
            s->first.base[c][i] = 0.5f;
            s->rgba[4 * i + (size_t)c] = 1;
        }
        s->first.metallic[i] = s->first.roughness[i] = 0.75f;
        s->first.specular[i] = s->first.ambient[i] = 1;
        cpu_shared_keep(&s->first, i, normal);
    }
}

static void teardown(samples *s) {
    render_surfaces_free(&s->first);
    render_surfaces_free(&s->later);
}

static bool take(const samples *s, uint32_t material, lmp_vec3 position, lmp_vec3 smooth) {
    const cpu_first first = { &s->first, render_nearness_of(&s->later.camera) };
    s->later.base[1][MIDDLE] = -1;
    const bool taken = cpu_shared_take(&first, material, position, smooth, MIDDLE, &s->later);
    assert_int_equal(taken, s->later.base[1][MIDDLE] == 0.5f);
    return taken;
}

static void the_same_surface_is_taken(void **state) {
    (void)state;
    samples s;
    setup(&s);
    cpu_shared_mark(&s.first, s.rgba, &whole);
    assert_true(take(&s, MATERIAL, (lmp_vec3) { 0, 0, 1 }, normal));
    assert_int_equal(s.later.seen[MIDDLE], MATERIAL);
    CHECK_WITHIN(fabsf(s.later.normal[2][MIDDLE] - 0.25f), 0);
    CHECK_WITHIN(fabsf(s.later.emission[0][MIDDLE] - 0.25f), 0);
    CHECK_WITHIN(fabsf(s.later.roughness[MIDDLE] - 0.75f), 0);
    /* four widths of a pixel are 0.04 */
    assert_true(take(&s, MATERIAL, (lmp_vec3) { 0, 0.035f, 1 }, normal));
    assert_false(take(&s, MATERIAL, (lmp_vec3) { 0, 0.045f, 1 }, normal));
    assert_false(take(&s, MATERIAL + 1, (lmp_vec3) { 0, 0, 1 }, normal));
    teardown(&s);
}

/* Normals differ in all directions, by angles below and above 1/64. */
static void normals_tell_surfaces_apart(void **state) {
    (void)state;
    samples s;
    setup(&s);
    for (int i = 0; i < 200; i++) {
        const lmp_vec3 n = check_random_direction(), aside = check_random_direction();
        const float along = n.x * aside.x + n.y * aside.y + n.z * aside.z;
        const lmp_vec3 across = { aside.x - along * n.x, aside.y - along * n.y,
                                  aside.z - along * n.z };
        const float length = sqrtf(across.x * across.x + across.y * across.y + across.z * across.z);
        if (length < 0.1f)
            continue;
        cpu_shared_keep(&s.first, MIDDLE, n);
        cpu_shared_mark(&s.first, s.rgba, &whole);
        for (int far = 0; far < 2; far++) {
            const float tilt = (far ? 0.020f : 0.012f) / length;
            const lmp_vec3 tilted = { n.x + tilt * across.x, n.y + tilt * across.y,
                                      n.z + tilt * across.z };
            assert_int_equal(take(&s, MATERIAL, (lmp_vec3) { 0, 0, 1 }, tilted), !far);
        }
    }
    teardown(&s);
}

/* Each neighbor counts, except across a corner; and a mark is removed once the pixel is even. */
static void uneven_pixels_are_not_taken(void **state) {
    (void)state;
    samples s;
    setup(&s);
    for (size_t i = 0; i < PIXELS; i++)
        for (int channel = 0; channel < 3; channel++) {
            const bool beside = i % 2 == 1 || i == MIDDLE;
            s.rgba[4 * i + (size_t)channel] = 0.5f;
            cpu_shared_mark(&s.first, s.rgba, &whole);
            assert_int_equal(take(&s, MATERIAL, (lmp_vec3) { 0, 0, 1 }, normal), !beside);
            s.rgba[4 * i + (size_t)channel] = 0.8f;
            cpu_shared_mark(&s.first, s.rgba, &whole);
            assert_true(take(&s, MATERIAL, (lmp_vec3) { 0, 0, 1 }, normal));
            s.rgba[4 * i + (size_t)channel] = NAN;
            cpu_shared_mark(&s.first, s.rgba, &whole);
            assert_int_equal(take(&s, MATERIAL, (lmp_vec3) { 0, 0, 1 }, normal), !beside);
            s.rgba[4 * i + (size_t)channel] = 1;
        }
    teardown(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_surface_is_taken),
        cmocka_unit_test(normals_tell_surfaces_apart),
        cmocka_unit_test(uneven_pixels_are_not_taken),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
