/* SPDX-License-Identifier: MIT */
/* JSON without holes when memory runs out: whichever request is refused, there is no text, or no
 * value. */
#include "app/base/error.h"
#include "app/base/file_json.h"
#include "tests/program/view.h"

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

static long requests, refused; /* the number of the request to refuse, or 0 */

/* Replaces malloc for all that is linked here, jansson included. */
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    return ++requests == refused ? NULL : __real_malloc(size);
}

typedef json_t *making(void);

static json_t *make_settings(void) {
    return view_settings_to_json(&state.now);
}

static json_t *make_light(void) {
    return scene_light_to_json(&state.now.lights[0], state.now.origin);
}

static char *text_of(making *make, long request) {
    base_error error = { "" };
    requests = 0;
    refused = request;
    char *const text = file_json_text(make(), true, "settings", &error);
    refused = 0;
    if (!text)
        assert_string_equal(error.text, "settings: out of memory");
    return text;
}

/* Every request of each text is refused once. */
static void what_has_no_memory_is_no_text(void **unused) {
    (void)unused;
    static making *const all[] = { make_settings, make_light };
    at(320, 240);
    key("n"); /* a light */
    assert_true(view_set_material(&state.now, "ball", "ggx:0.3"));
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        char *const whole = text_of(all[i], 0);
        const long count = requests;
        assert_non_null(whole);
        assert_true(count > 20); /* with all that jansson requested */
        for (long request = 1; request <= count; request++) {
            char *const text = text_of(all[i], request);
            if (text)
                fail_msg("request %ld of %ld is refused, and there is a text: %s", request, count,
                         text);
            free(text);
        }
        char *const again = text_of(all[i], 0); /* none of it stays */
        assert_string_equal(again, whole);
        free(again);
        free(whole);
        printf("tried: %ld requests for memory that were refused\n", count);
    }
}

/* The text fills the parser's buffer more than once. */
static void what_has_no_memory_is_not_read(void **unused) {
    (void)unused;
    static const char text[] =
        "{ \"a name of more than sixteen letters, and of more than thirty-two\": "
        "[ 0.1234567890123456789, true, { \"text\": \"a \\u0074ext of many letters, too\" } ] }";
    base_error error;
    json_t *root = NULL;
    for (long request = 1; !root; request++) {
        requests = 0;
        refused = request;
        root = file_parse_json("text", text, strlen(text), &error);
        refused = 0;
        if (root)
            assert_in_range(requests, 8, request - 1);
        else
            assert_string_equal(error.text, "text: is JSON that does not fit into memory");
    }
    json_decref(root);
}

int main(void) {
    const struct CMUnitTest tests[] = { TEST(what_has_no_memory_is_no_text),
                                        TEST(what_has_no_memory_is_not_read) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
