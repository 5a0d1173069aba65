/* SPDX-License-Identifier: MIT */
/* The browser demo's own part of cJSON reads valid texts as the grammar means them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <cjson/cJSON.h>

static cJSON *parse(const char *text) {
    /* bytes that follow are not read */
    char *const copy = malloc(strlen(text));
    assert_non_null(copy);
    memcpy(copy, text, strlen(text));
    cJSON *const root = cJSON_ParseWithLength(copy, strlen(text));
    free(copy);
    return root;
}

static void values_of_every_kind_are_told_apart(void **state) {
    (void)state;
    cJSON *const root = parse(" [ null , true,false, -1.5e+2, 0, \"s\", [], {} ]\n");
    assert_true(cJSON_IsArray(root));
    assert_int_equal(cJSON_GetArraySize(root), 8);
    assert_int_equal(cJSON_GetArrayItem(root, 0)->type, cJSON_NULL);
    assert_true(cJSON_IsTrue(cJSON_GetArrayItem(root, 1)));
    assert_true(cJSON_IsBool(cJSON_GetArrayItem(root, 2)));
    assert_false(cJSON_IsTrue(cJSON_GetArrayItem(root, 2)));
    assert_true(cJSON_IsNumber(cJSON_GetArrayItem(root, 3)));
    assert_true(cJSON_GetArrayItem(root, 3)->valuedouble == -150);
    assert_true(cJSON_GetArrayItem(root, 4)->valuedouble == 0);
    assert_string_equal(cJSON_GetArrayItem(root, 5)->valuestring, "s");
    assert_int_equal(cJSON_GetArraySize(cJSON_GetArrayItem(root, 6)), 0);
    assert_true(cJSON_IsObject(cJSON_GetArrayItem(root, 7)));
    assert_null(cJSON_GetArrayItem(root, 8));
    cJSON_Delete(root);
}

static void members_are_found_by_their_exact_name(void **state) {
    (void)state;
    cJSON *const root = parse("{\"a\" : {\"b\":[1, 2]} ,\"A\":3, \"\\u0061b\":4}");
    const cJSON *const inner = cJSON_GetObjectItemCaseSensitive(root, "a");
    const cJSON *const list = cJSON_GetObjectItemCaseSensitive(inner, "b");
    assert_true(cJSON_GetArrayItem(list, 1)->valuedouble == 2);
    assert_true(cJSON_GetObjectItemCaseSensitive(root, "A")->valuedouble == 3);
    assert_true(cJSON_GetObjectItemCaseSensitive(root, "ab")->valuedouble == 4);
    assert_null(cJSON_GetObjectItemCaseSensitive(root, "c"));
    assert_null(cJSON_GetObjectItemCaseSensitive(NULL, "c"));
    cJSON_Delete(root);
}

static void a_detached_member_is_no_longer_there(void **state) {
    (void)state;
    static const char *const names[] = { "b", "a", "c" };
    cJSON *const root = parse("{\"a\":[1],\"b\":2,\"c\":3}");
    for (size_t i = 0; i < 3; i++) {
        cJSON *const item = cJSON_GetObjectItemCaseSensitive(root, names[i]);
        assert_ptr_equal(cJSON_DetachItemViaPointer(root, item), item);
        assert_null(item->next);
        assert_null(cJSON_GetObjectItemCaseSensitive(root, names[i]));
        assert_int_equal(cJSON_GetArraySize(root), 2 - (int)i);
        cJSON_Delete(item);
    }
    cJSON_Delete(root);
}

static void escapes_become_utf8(void **state) {
    (void)state;
    cJSON *const root =
        parse("\"\\\"\\\\\\/\\b\\f\\n\\r\\t \\u0041\\u00e9\\u20AC\\ud83c\\udfee \xc3\xa9\"");
    assert_true(cJSON_IsString(root));
    assert_string_equal(root->valuestring,
                        "\"\\/\b\f\n\r\t A\xc3\xa9\xe2\x82\xac\xf0\x9f\x8f\xae \xc3\xa9");
    cJSON_Delete(root);
}

static void values_nest_as_deep_as_the_grammar_allows(void **state) {
    (void)state;
    enum { DEPTH = 1000 };
    char text[2 * DEPTH + 1] = "";
    memset(text, '[', DEPTH);
    memset(text + DEPTH, ']', DEPTH);
    cJSON *const root = parse(text);
    int depth = 0;
    for (const cJSON *item = root; item; item = item->child)
        depth++;
    assert_int_equal(depth, DEPTH);
    cJSON_Delete(root);
}

/* --- memory that runs out --------------------------------------------------------------------- */

static int granted, held;

static void *allocate(size_t size) {
    if (granted == 0)
        return NULL;
    granted--;
    held++;
    return malloc(size);
}

static void release(void *memory) {
    held -= memory != NULL;
    free(memory);
}

static void whatever_memory_is_refused_all_of_it_is_given_back(void **state) {
    (void)state;
    cJSON_InitHooks(&(cJSON_Hooks) { allocate, release });
    for (int most = 0; most < 40; most++) {
        granted = most;
        held = 0;
        cJSON_Delete(parse("{\"a\":[1,{\"b\":\"c\"},[]],\"d\":{\"e\":[true,\"f\"]},\"g\":\"h\"}"));
        assert_int_equal(held, 0);
    }
    cJSON_InitHooks(&(cJSON_Hooks) { malloc, free });
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_of_every_kind_are_told_apart),
        cmocka_unit_test(members_are_found_by_their_exact_name),
        cmocka_unit_test(a_detached_member_is_no_longer_there),
        cmocka_unit_test(escapes_become_utf8),
        cmocka_unit_test(values_nest_as_deep_as_the_grammar_allows),
        cmocka_unit_test(whatever_memory_is_refused_all_of_it_is_given_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
