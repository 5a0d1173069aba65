/* SPDX-License-Identifier: MIT */
/* cmocka.h - the part of cmocka that the library's tests use, which Debian has only for the
 * machine's own architecture. A failed assertion says where it failed and ends the program. */
#ifndef LAMPION_CROSS_CMOCKA_H
#define LAMPION_CROSS_CMOCKA_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define print_message                    printf
#define print_error(...)                 fprintf(stderr, __VA_ARGS__)
#define _fail(file, line)                (print_error("%s:%d: failed\n", file, line), exit(1))
#define fail_msg(...)                    (print_error(__VA_ARGS__), _fail(__FILE__, __LINE__))
#define assert_true(holds)               ((holds) ? (void)0 : (void)_fail(__FILE__, __LINE__))
#define assert_false(holds)              assert_true(!(holds))
#define assert_null(pointer)             assert_true(!(pointer))
#define assert_non_null(pointer)         assert_true(pointer)
#define assert_int_equal(a, b)           assert_true((a) == (b))
#define assert_int_not_equal(a, b)       assert_true((a) != (b))
#define assert_string_equal(a, b)        assert_true(strcmp(a, b) == 0)
#define assert_string_not_equal(a, b)    assert_true(strcmp(a, b) != 0)
#define assert_memory_equal(a, b, bytes) assert_true(memcmp(a, b, bytes) == 0)

/* Ignores a filter by name: all tests are run. */
#define cmocka_set_test_filter(pattern) ((void)(pattern))

struct CMUnitTest {
    const char *name;
    void (*run)(void **state);
};
#define cmocka_unit_test(function)                                                                 \
    { #function, function }

static inline int run_tests(const struct CMUnitTest *test, size_t count, int (*setup)(void **)) {
    void *state = NULL;
    if (setup && setup(&state) != 0)
        return 1;
    for (size_t i = 0; i < count; i++)
        test[i].run(&state);
    return 0;
}
#define cmocka_run_group_tests(tests, setup, teardown)                                             \
    run_tests(tests, sizeof(tests) / sizeof *(tests), setup)

#endif
