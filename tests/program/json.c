/* SPDX-License-Identifier: MIT */
/* JSON that memory was refused for is no JSON with holes: whichever request of it is refused, there
 * is no text, or the whole one. */
#include "app/file/file.h"
#include "tests/program/view.h"

#include <cjson/cJSON.h>
#include <stdlib.h>

static long requests, refused; /* the number of the one that is, or 0 */

/* In place of malloc of all that is linked here, which is what cJSON asks for memory, too. */
void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    return ++requests == refused ? NULL : __real_malloc(size);
}

typedef cJSON *making(void);

static cJSON *make_settings(void) {
    return view_settings_to_json(&state.now);
}

static cJSON *make_light(void) {
    return scene_light_to_json(&state.now.lights[0], state.now.origin);
}

static char *text_of(making *make, long request) {
    cli_error error = { "" };
    requests = 0;
    refused = request;
    char *const text = file_json_text(make(), true, "settings", &error);
    refused = 0;
    if (!text)
        assert_string_equal(error.text, "settings: out of memory");
    return text;
}

/* Every request of each. */
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
        assert_true(count > 20); /* all that cJSON asked for among them */
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

int main(void) {
    const struct CMUnitTest tests[] = { TEST(what_has_no_memory_is_no_text) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
