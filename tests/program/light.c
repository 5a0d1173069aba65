/* SPDX-License-Identifier: MIT */
/* The kinds of light: their table, their JSON and their documentation. */
#include "app/scene/light.h"
#include "app/base/error.h"
#include "app/base/file.h"

#include "tests/oracle/check.h"

#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Makes corners of a convex polygon in a plane, each at the end of a way across and one up. */
static void random_corners(lmp_light *light) {
    const lmp_vec3 across = check_random_direction(), up = { -across.y, across.x, across.z };
    const int count = light->corner_count = 3 + (int)check_random_between(0, 5.99);
    for (int i = 0; i < count; i++) {
        const double angle = 2 * M_PI * i / count;
        const float x = (float)cos(angle), y = (float)sin(angle);
        light->corner[i] = (lmp_vec3) { x * across.x + y * up.x, x * across.y + y * up.y,
                                        x * across.z + y * up.z };
    }
}

/* Returns a light of a kind, with every member somewhere in its range. */
static scene_light random_light(int kind) {
    scene_light light = { .hidden = check_random_between(0, 2) > 1 };
    light.emitter.kind = (lmp_light_kind)kind;
    for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++) {
        float *value = scene_light_value(&light.emitter, m);
        const lmp_vec3 direction = check_random_direction();
        const float along[3] = { direction.x, direction.y, direction.z };
        if (m->type == SCENE_LIGHT_FLAG)
            *scene_light_flag(&light.emitter, m) = check_random_between(0, 2) > 1;
        else if (m->type == SCENE_LIGHT_CORNERS)
            random_corners(&light.emitter);
        else
            for (int k = 0; k < scene_light_count(&light.emitter, m); k++)
                value[k] = m->type == SCENE_LIGHT_DIRECTION
                               ? along[k]
                               : (float)check_random_between(0.01, 3.1);
    }
    if (light.emitter.inner > light.emitter.outer)
        light.emitter.inner = light.emitter.outer;
    return light;
}

static bool read_text(const char *text, scene_light *light, scene_light_error *wrong) {
    json_t *root = json_loads(text, 0, NULL);
    assert_non_null(root);
    const bool ok = scene_light_from_json(root, (const double[3]) { 0 }, light, wrong);
    json_decref(root);
    return ok;
}

static void every_kind_is_read_as_it_was_written(void **state) {
    (void)state;
    for (int i = 0; i < 600; i++) {
        const scene_light light = random_light(i % SCENE_LIGHT_KIND_COUNT);
        scene_light again;
        scene_light_error wrong = { "" };
        json_t *object = scene_light_to_json(&light, (const double[3]) { 0 });
        char *text = json_dumps(object, JSON_COMPACT);
        if (!read_text(text, &again, &wrong))
            fail_msg("%s: %s", text, wrong.text);
        assert_memory_equal(&light, &again, sizeof light);
        free(text);
        json_decref(object);
    }
}

static void a_light_without_a_kind_is_a_sphere(void **state) {
    (void)state;
    scene_light light;
    scene_light_error wrong;
    assert_true(read_text("{\"position\":[1,2,3],\"radius\":2,\"radiance\":5}", &light, &wrong));
    assert_int_equal(light.emitter.kind, LMP_LIGHT_SPHERE);
    assert_true(light.emitter.radiance.b == 5 && light.emitter.position.y == 2);
}

static void directions_become_unit_vectors(void **state) {
    (void)state;
    scene_light light;
    scene_light_error wrong;
    assert_true(read_text("{\"kind\":\"directional\",\"direction\":[0,3,4],\"irradiance\":1}",
                          &light, &wrong));
    CHECK_WITHIN(fabs((double)light.emitter.direction.y - 0.6), 1e-7);
    CHECK_WITHIN(fabs((double)light.emitter.direction.z - 0.8), 1e-7);
}

/* Each member in turn is far outside its range. */
static void values_out_of_range_are_named(void **state) {
    (void)state;
    const float bad[] = { NAN, INFINITY, -1e30f, 1e30f };
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++)
        for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++)
            for (size_t i = 0; i < sizeof bad / sizeof *bad && !m->convert; i++) {
                if (m->type == SCENE_LIGHT_FLAG)
                    continue;
                scene_light light = random_light(kind);
                scene_light_error wrong = { "" };
                char path[32];
                assert_true(scene_light_check(&light, &wrong));
                *scene_light_value(&light.emitter, m) = bad[i];
                assert_false(scene_light_check(&light, &wrong));
                snprintf(path, sizeof path, ".%s is", m->name);
                assert_non_null(strstr(wrong.text, path));
            }
}

/* A square of side 2 has the area 4; a disk of radius 2 and a tube of radius 1 and length 2 between
 * the centers of its ends, 4 pi and 8 pi, of which one direction sees 4 + pi. Power is pi times the
 * radiance and all that shines, intensity the radiance times what faces one direction. */
static void power_and_intensity_are_those_of_the_shape(void **state) {
    (void)state;
    static const struct {
        const char *shape;
        double shining, facing;
    } cases[] = {
        { "\"kind\":\"rectangle\",\"half_width\":[1,0,0],\"half_height\":[0,1,0]", 4, 4 },
        { "\"kind\":\"rectangle\",\"half_width\":[1,0,0],\"half_height\":[0,1,0],"
          "\"two_sided\":true",
          8, 4 },
        { "\"kind\":\"disk\",\"direction\":[0,0,1],\"radius\":2", 4 * M_PI, 4 * M_PI },
        { "\"kind\":\"tube\",\"half_axis\":[0,1,0],\"radius\":1", 8 * M_PI, 4 + M_PI },
        { "\"kind\":\"polygon\",\"corners\":[[0,0,0],[2,0,0],[0,2,0]]", 2, 2 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int power = 0; power < 2; power++) {
            char text[256];
            scene_light light;
            scene_light_error wrong = { "" };
            snprintf(text, sizeof text, "{%s,\"position\":[0,0,0],\"%s\":8}", cases[i].shape,
                     power ? "power" : "intensity");
            if (!read_text(text, &light, &wrong))
                fail_msg("%s: %s", text, wrong.text);
            const double exact = 8 / (power ? M_PI * cases[i].shining : cases[i].facing);
            CHECK_WITHIN(fabs((double)light.emitter.radiance.g - exact), 1e-6 * exact);
        }
}

static lmp_vec3 rotate_quarter(lmp_vec3 v, const void *unused) {
    (void)unused;
    return (lmp_vec3) { -v.y, v.x, v.z };
}

/* A light that is rotated stays at its position, keeps its extent and faces elsewhere; one of twice
 * the size has a quarter of the radiance. */
static void lights_of_every_kind_rotate_and_grow(void **state) {
    (void)state;
    for (int i = 0; i < 200; i++) {
        const lmp_light light = random_light(i % SCENE_LIGHT_KIND_COUNT).emitter;
        lmp_light rotated = light, grown = light;
        const double extent = (double)scene_light_extent(&light);
        scene_light_rotate(&rotated, rotate_quarter, NULL);
        scene_light_resize(&grown, 2);
        assert_memory_equal(&rotated.position, &light.position, sizeof light.position);
        CHECK_WITHIN(fabs((double)scene_light_extent(&rotated) - extent), 1e-5 * extent);
        CHECK_WITHIN(fabs((double)scene_light_extent(&grown) - 2 * extent), 1e-5 * extent);
        CHECK_WITHIN(fabs((double)grown.radiance.r - (double)light.radiance.r / 4), 1e-6);
        if (light.kind == LMP_LIGHT_RECTANGLE || light.kind == LMP_LIGHT_TUBE)
            assert_true(rotated.half[0].x == -light.half[0].y &&
                        rotated.half[0].y == light.half[0].x);
    }
}

/* docs/lights.md has a row `kind` | `member` … for each member, in this order. */
static void the_document_names_every_kind_and_member(void **state) {
    (void)state;
    char *text, row[256];
    size_t size;
    base_error error;
    assert_true(file_read(DOCUMENT, 1 << 20, (void **)&text, &size, &error));
    for (int kind = 0; kind < SCENE_LIGHT_KIND_COUNT; kind++) {
        snprintf(row, sizeof row, "\n| `%s` |", scene_light_kinds[kind].name);
        char *at = strstr(text, row), *end = at ? strchr(at + 1, '\n') : NULL;
        if (!end)
            fail_msg("no row for %s", scene_light_kinds[kind].name);
        *end = '\0';
        for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++) {
            snprintf(row, sizeof row, "`%s`", m->name);
            at = at ? strstr(at, row) : NULL;
            if (!at)
                fail_msg("no %s of %s", row, scene_light_kinds[kind].name);
        }
        *end = '\n';
    }
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read_as_it_was_written),
        cmocka_unit_test(a_light_without_a_kind_is_a_sphere),
        cmocka_unit_test(directions_become_unit_vectors),
        cmocka_unit_test(values_out_of_range_are_named),
        cmocka_unit_test(power_and_intensity_are_those_of_the_shape),
        cmocka_unit_test(lights_of_every_kind_rotate_and_grow),
        cmocka_unit_test(the_document_names_every_kind_and_member),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
