/* SPDX-License-Identifier: MIT */
/* The browser demo's own part of jansson reads what the grammar allows, and nothing else. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "app/base/file_json.h"

/* How many requests for memory are granted; -1 for all. */
static int granted = -1;

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    if (granted == 0)
        return NULL;
    granted -= granted > 0;
    return __real_malloc(size);
}

static json_t *parse(const char *text) {
    /* bytes that follow are not read */
    json_error_t error;
    char *const copy = __real_malloc(strlen(text) + 1);
    assert_non_null(copy);
    memcpy(copy, text, strlen(text));
    json_t *const root = file_json_load(copy, strlen(text), &error);
    free(copy);
    return root;
}

static void values_of_every_kind_are_told_apart(void **state) {
    (void)state;
    json_t *const root = parse(" [ null , true,false, -1.5e+2, 0, \"s\", [], {} ]\n");
    assert_true(json_is_array(root));
    assert_int_equal(json_array_size(root), 8);
    assert_true(json_is_null(json_array_get(root, 0)));
    assert_true(json_is_true(json_array_get(root, 1)));
    assert_true(json_is_boolean(json_array_get(root, 2)));
    assert_false(json_is_true(json_array_get(root, 2)));
    assert_true(json_is_number(json_array_get(root, 3)));
    assert_true(json_number_value(json_array_get(root, 3)) == -150);
    assert_true(json_number_value(json_array_get(root, 4)) == 0);
    assert_string_equal(json_string_value(json_array_get(root, 5)), "s");
    assert_int_equal(json_array_size(json_array_get(root, 6)), 0);
    assert_true(json_is_object(json_array_get(root, 7)));
    assert_null(json_array_get(root, 8));
    assert_null(json_string_value(json_array_get(root, 4)));
    json_decref(root);
}

static void members_are_found_by_their_exact_name(void **state) {
    (void)state;
    json_t *const root = parse("{\"a\" : {\"b\":[1, 2]} ,\"A\":3, \"\\u0061b\":4}");
    const json_t *const inner = json_object_get(root, "a");
    const json_t *const list = json_object_get(inner, "b");
    assert_true(json_number_value(json_array_get(list, 1)) == 2);
    assert_true(json_number_value(json_object_get(root, "A")) == 3);
    assert_true(json_number_value(json_object_get(root, "ab")) == 4);
    assert_null(json_object_get(root, "c"));
    assert_null(json_object_get(list, "c"));
    assert_null(json_object_get(NULL, "c"));
    json_decref(root);
}

static void members_come_in_their_order(void **state) {
    (void)state;
    static const char *const names[] = { "b", "c", "a" };
    json_t *const root = parse("{\"b\":0,\"c\":1,\"a\":2}"), *item;
    const char *name;
    int i = 0;
    json_object_foreach (root, name, item) {
        assert_string_equal(name, names[i]);
        assert_true(json_number_value(item) == i++);
    }
    assert_int_equal(i, 3);
    json_decref(root);
}

static void a_deleted_member_is_no_longer_there(void **state) {
    (void)state;
    static const char *const names[] = { "b", "a", "c" };
    json_t *const root = parse("{\"a\":[1],\"b\":2,\"c\":3}");
    for (size_t i = 0; i < 3; i++) {
        assert_int_equal(json_object_del(root, names[i]), 0);
        assert_null(json_object_get(root, names[i]));
        assert_int_equal(json_object_size(root), 2 - i);
    }
    assert_int_not_equal(json_object_del(root, "a"), 0);
    json_decref(root);
}

static void escapes_become_utf8(void **state) {
    (void)state;
    json_t *const root =
        parse("\"\\\"\\\\\\/\\b\\f\\n\\r\\t \\u0041\\u00e9\\u20AC\\ud83c\\udfee \xc3\xa9\"");
    assert_string_equal(json_string_value(root),
                        "\"\\/\b\f\n\r\t A\xc3\xa9\xe2\x82\xac\xf0\x9f\x8f\xae \xc3\xa9");
    json_decref(root);
}

static void what_the_grammar_does_not_allow_is_refused(void **state) {
    (void)state;
    static const char *const wrong[] = {
        "",
        "[",
        "[1",
        "[1,]",
        "{\"a\":1,}",
        "{\"a\" 1}",
        "{a:1}",
        "01",
        "+1",
        ".5",
        "1.",
        "1e",
        "1e999",
        "NaN",
        "nul",
        "\"",
        "\"\\x\"",
        "\"\\u00g0\"",
        "\"\\u0000\"",
        "\"\n\"",
        "\"\\",
        "[1] x",
        "\"\\ud83c\"",
        "\"\\udfee\"",
        "{\"a\":1,\"a\":2}",
        "{\"a\\u0000\":1}",
        "'a'",
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        if (parse(wrong[i]))
            fail_msg("%s is read", wrong[i]);
    json_error_t error;
    assert_null(file_json_load("{\n \"a\": 01}", 10, &error));
    assert_int_equal(error.line, 2);
    assert_int_equal(error.column, 8);
    assert_int_equal(json_error_code(&error), json_error_invalid_syntax);
}

static void values_nest_as_deep_as_in_jansson(void **state) {
    (void)state;
    enum { DEPTH = 2048 };
    char text[2 * DEPTH + 3] = "";
    memset(text, '[', DEPTH);
    memset(text + DEPTH, ']', DEPTH);
    json_t *const root = parse(text);
    int depth = 0;
    for (const json_t *item = root; item; item = json_array_get(item, 0))
        depth++;
    assert_int_equal(depth, DEPTH);
    json_decref(root);
    memset(text, '[', DEPTH + 1);
    memset(text + DEPTH + 1, ']', DEPTH + 1);
    assert_null(parse(text));
}

static void without_memory_there_is_no_value(void **state) {
    (void)state;
    static const char text[] =
        "{\"a\":[1,{\"b\":\"c\"},[]],\"d\":{\"e\":[true,\"f\"]},\"g\":\"h\"}";
    json_error_t error;
    for (granted = 0; granted < 100; granted++) {
        const int most = granted;
        json_t *const root = file_json_load(text, sizeof text - 1, &error);
        granted = most;
        if (root) {
            json_decref(root);
            break;
        }
        assert_int_equal(json_error_code(&error), json_error_out_of_memory);
    }
    assert_in_range(granted, 20, 99);
    granted = -1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_every_kind_are_told_apart),
        cmocka_unit_test(members_are_found_by_their_exact_name),
        cmocka_unit_test(members_come_in_their_order),
        cmocka_unit_test(a_deleted_member_is_no_longer_there),
        cmocka_unit_test(escapes_become_utf8),
        cmocka_unit_test(what_the_grammar_does_not_allow_is_refused),
        cmocka_unit_test(values_nest_as_deep_as_in_jansson),
        cmocka_unit_test(without_memory_there_is_no_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
