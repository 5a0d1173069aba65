/* SPDX-License-Identifier: MIT */
/* Fields as bytes. */
#include "tests/unit/damage.h"
#include "tests/unit/fields.h"

#include <string.h>

enum { LIGHTS = 9, VALUES = 3 * 2 * 2 };

static const lmp_field_desc grid = {
    .bands = 2, .nodes = { 5, 4, 3 }, .origin = { -1, 0, 1 }, .light_max = 12, .reach = 1.5f
};

static lmp_field *one_of_each_kind(void) {
    lmp_light lights[LIGHTS];
    field_sphere_lights(-2, 5, LIGHTS, lights);
    for (int i = 0; i <= LMP_LIGHT_HEMISPHERE; i++) {
        lights[i].kind = (lmp_light_kind)i;
        lights[i].direction = check_random_direction();
        lights[i].angle = lights[i].outer = 0.5f;
        lights[i].ground = (lmp_rgb) { 1, 2, 3 };
    }
    return field_of(&grid, lights, LIGHTS);
}

static unsigned char *written(const lmp_field *field, size_t *size) {
    *size = lmp_field_size(field);
    unsigned char *bytes = malloc(*size);
    assert_non_null(bytes);
    assert_int_equal(lmp_field_write(field, *size - 1, bytes), LMP_ERROR_ARGUMENT);
    assert_int_equal(lmp_field_write(field, *size, bytes), LMP_OK);
    return bytes;
}

static void a_field_comes_back_and_goes_on(void **test) {
    (void)test;
    size_t size, again_size;
    lmp_field *field = one_of_each_kind(), *read;
    unsigned char *bytes = written(field, &size);
    assert_int_equal(lmp_field_read(NULL, bytes, size, NULL, &read), LMP_OK);
    unsigned char *again = written(read, &again_size);
    assert_int_equal(size, again_size);
    assert_memory_equal(bytes, again, size);
    const lmp_light moved = field_sphere_light(0, 3);
    const size_t at = 2;
    lmp_field_move_n(NULL, field, &at, &moved, 1);
    lmp_field_move_n(NULL, read, &at, &moved, 1);
    for (int i = 0; i < 100; i++) {
        const lmp_vec3 point = field_point(-2, 5);
        float a[VALUES], b[VALUES];
        lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(a, 0));
        lmp_field_eval_n(read, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(b, 0));
        assert_memory_equal(a, b, sizeof a);
    }
    free(bytes);
    free(again);
    lmp_field_destroy(field);
    lmp_field_destroy(read);
}

static lmp_result read_and_use(const unsigned char *bytes, size_t size) {
    lmp_field *field = (lmp_field *)1;
    lmp_parse_error error = { size + 1, "" };
    const lmp_result result = lmp_field_read(NULL, bytes, size, &error, &field);
    assert_true(result == LMP_OK || (error.text[0] && error.offset <= size));
    assert_int_equal(!field, result != LMP_OK);
    if (result == LMP_OK) {
        const lmp_vec3 point = { 0.5f, 1, 2 };
        float sh[3 * LMP_FIELD_BANDS_MAX * LMP_FIELD_BANDS_MAX];
        lmp_field_eval_n(field, lmp_vec3_array_same(&point), 1, lmp_sh_interleaved(sh, 0));
        if (lmp_field_describe(field).light_count > 0)
            lmp_field_remove(NULL, field, 0);
    }
    lmp_field_destroy(field);
    return result;
}

static void damaged_bytes_are_refused(void **test) {
    (void)test;
    size_t size;
    lmp_field *field = one_of_each_kind();
    unsigned char *bytes = written(field, &size);
    lmp_field_destroy(field);
    damage_is_refused(bytes, size, read_and_use);
    damage_stays_in_bounds(bytes, size, 12, 64 + 68 * LIGHTS, check_count(3000, 100000),
                           read_and_use);
    free(bytes);
}

static void numbers_outside_their_ranges_are_refused(void **test) {
    (void)test;
    static const struct {
        size_t at;
        float value;
    } wrong[] = {
        { 28, INFINITY },     /* origin */
        { 40, 0 },            /* a cell's edge */
        { 44, NAN },          /* a cell's edge */
        { 52, 0 },            /* reach */
        { 64 + 4, NAN },      /* a light's position */
        { 64 + 28, -1 },      /* a light's radius */
        { 64 + 68 * 9, NAN }, /* a node */
    };
    size_t size;
    lmp_field *field = one_of_each_kind();
    unsigned char *bytes = written(field, &size);
    lmp_field_destroy(field);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        unsigned char kept[4];
        memcpy(kept, bytes + wrong[i].at, 4);
        lmpi_bytes_store_f32(bytes + wrong[i].at, wrong[i].value);
        damage_sign(bytes, size);
        assert_int_equal(read_and_use(bytes, size), LMP_ERROR_FORMAT);
        memcpy(bytes + wrong[i].at, kept, 4);
    }
    for (size_t at = 12; at < 64; at += at == 24 ? 32 : 4) { /* counts */
        if (at > 24 && at < 56)
            continue;
        unsigned char kept[4];
        memcpy(kept, bytes + at, 4);
        for (uint32_t value = 0; value != 3; value = value == 0 ? 0xffffffffu : 3) {
            lmpi_bytes_store_u32(bytes + at, value);
            damage_sign(bytes, size);
            assert_int_equal(read_and_use(bytes, size), LMP_ERROR_FORMAT);
        }
        memcpy(bytes + at, kept, 4);
    }
    free(bytes);
}

/* A member of 0, the default, is not valid: a reader that took the default instead would accept
 * these. */
static void no_member_is_left_to_its_default(void **test) {
    (void)test;
    lmp_field *dark = field_of(&(lmp_field_desc) { .bands = 5 }, NULL, 0);
    size_t size;
    unsigned char *bytes = written(dark, &size);
    lmp_field_destroy(dark);
    for (size_t at = 12; at < 60; at += 4) {
        if (at >= 28 && at < 40) /* the origin, which may be 0 */
            continue;
        unsigned char kept[4];
        memcpy(kept, bytes + at, 4);
        lmpi_bytes_store_u32(bytes + at, 0);
        damage_sign(bytes, size);
        assert_int_equal(read_and_use(bytes, size), LMP_ERROR_FORMAT);
        memcpy(bytes + at, kept, 4);
    }
    memset(bytes + 40, 0, 12); /* all edges of a cell */
    damage_sign(bytes, size);
    assert_int_equal(read_and_use(bytes, size), LMP_ERROR_FORMAT);
    free(bytes);
}

/* Lengths may have any unit; powers of two keep the rounding the same. */
static void units_of_length_change_no_size(void **test) {
    (void)test;
    for (int nodes = 8; nodes <= 24; nodes += 8) {
        size_t sizes[3] = { 0 };
        for (int k = 0; k < 3; k++) {
            const float unit = (const float[]) { 1, 0.0625f, 16 }[k];
            const lmp_field_desc desc = { .origin = { unit, 2 * unit, 0 },
                                          .cell = { unit, unit, unit },
                                          .nodes = { nodes, nodes, nodes },
                                          .reach = 2,
                                          .light_max = 4096 };
            lmp_field *field;
            assert_int_equal(lmp_field_create(NULL, &desc, &field), LMP_OK);
            sizes[k] = lmp_field_describe(field).bytes;
            lmp_field_destroy(field);
        }
        assert_true(sizes[0] > 0);
        assert_int_equal(sizes[1], sizes[0]);
        assert_int_equal(sizes[2], sizes[0]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(units_of_length_change_no_size),
        cmocka_unit_test(a_field_comes_back_and_goes_on),
        cmocka_unit_test(damaged_bytes_are_refused),
        cmocka_unit_test(numbers_outside_their_ranges_are_refused),
        cmocka_unit_test(no_member_is_left_to_its_default),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
