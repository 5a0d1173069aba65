/* SPDX-License-Identifier: MIT */
/* Libraries that are opened when they are needed. */
#include "app/base/shared_library.h"
#include "tests/oracle/check.h"

#include <string.h>

typedef struct functions {
    double (*first)(double), (*second)(double);
} functions;

static void their_functions_are_found(void **state) {
    (void)state;
    static const char *const names[] = { "cos", "sqrt" };
    functions math = { 0 };
    base_error error;
    assert_true(shared_library_open("libm.so.6", names, 2, &math, &error));
    assert_true(math.first(0) == 1 && math.second(9) == 3);
    /* What is open is not looked for again. */
    assert_true(shared_library_open("liblampion-missing.so", names, 2, &math, &error));
}

static void what_is_missing_is_named(void **state) {
    (void)state;
    static const char *const names[] = { "cos", "lampion_missing" };
    functions math = { 0 };
    base_error error;
    assert_false(shared_library_open("liblampion-missing.so", names, 2, &math, &error));
    assert_non_null(strstr(error.text, "the library liblampion-missing.so is missing: "));
    assert_false(shared_library_open("libm.so.6", names, 2, &math, &error));
    assert_string_equal(error.text, "the library libm.so.6 has no lampion_missing");
    assert_null(math.first);
}

int main(void) {
    const struct CMUnitTest tests[] = { cmocka_unit_test(their_functions_are_found),
                                        cmocka_unit_test(what_is_missing_is_named) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
