/* SPDX-License-Identifier: MIT */
/* The kinds of light: their table, their JSON and their documentation. */
#include "app/scene/light.h"
#include "app/file/file.h"

#include "tests/oracle/check.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A light of a kind, every member of it somewhere in its range. */
static scene_light random_light(int kind) {
    scene_light light = { .hidden = check_random_between(0, 2) > 1 };
    light.emitter.kind = (lmp_light_kind)kind;
    for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++) {
        float *value = scene_light_value(&light.emitter, m);
        const lmp_vec3 direction = check_random_direction();
        const float along[3] = { direction.x, direction.y, direction.z };
        for (int k = 0; k < scene_light_count(m); k++)
            value[k] = m->type == SCENE_LIGHT_DIRECTION ? along[k]
                                                        : (float)check_random_between(0.01, 3.1);
    }
    if (light.emitter.inner > light.emitter.outer)
        light.emitter.inner = light.emitter.outer;
    return light;
}

static bool read_text(const char *text, scene_light *light, scene_light_error *wrong) {
    cJSON *root = cJSON_Parse(text);
    assert_non_null(root);
    const bool ok = scene_light_from_json(root, (const double[3]) { 0 }, light, wrong);
    cJSON_Delete(root);
    return ok;
}

static void every_kind_is_read_as_it_was_written(void **state) {
    (void)state;
    for (int i = 0; i < 600; i++) {
        const scene_light light = random_light(i % LMP_LIGHT_KINDS);
        scene_light again;
        scene_light_error wrong = { "" };
        cJSON *object = scene_light_to_json(&light, (const double[3]) { 0 });
        char *text = cJSON_PrintUnformatted(object);
        if (!read_text(text, &again, &wrong))
            fail_msg("%s: %s", text, wrong.text);
        assert_memory_equal(&light, &again, sizeof light);
        cJSON_free(text);
        cJSON_Delete(object);
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

/* Each member in turn, far out of any range. */
static void values_out_of_range_are_named(void **state) {
    (void)state;
    const float bad[] = { NAN, INFINITY, -1e30f, 1e30f };
    for (int kind = 0; kind < LMP_LIGHT_KINDS; kind++)
        for (const scene_light_member *m = scene_light_kinds[kind].members; m->name; m++)
            for (size_t i = 0; i < sizeof bad / sizeof *bad && !m->convert; i++) {
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

/* docs/lights.md has a row `kind` | `member` … for each of them, in this order. */
static void the_document_names_every_kind_and_member(void **state) {
    (void)state;
    char *text, row[256];
    size_t size;
    cli_error error;
    assert_true(file_read(DOCUMENT, 1 << 20, (void **)&text, &size, &error));
    for (int kind = 0; kind < LMP_LIGHT_KINDS; kind++) {
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
        cmocka_unit_test(the_document_names_every_kind_and_member),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
