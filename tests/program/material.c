/* SPDX-License-Identifier: MIT */
/* Materials from files: a reader that a file makes crash, or never end, does so in a child, and the
 * program reports it in one line. */
#include "app/scene/material.h"
#include "tests/program/folder.h"

#include <signal.h>
#include <unistd.h>

/* The linker replaces the library's readers by these. */
lmp_result __wrap_lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                                     lmp_parse_error *error, lmp_brdf **brdf);
lmp_result __real_lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                                     lmp_parse_error *error, lmp_brdf **brdf);
lmp_result __wrap_lmp_brdf_table_read(const lmp_host *host, const void *data, size_t size,
                                      lmp_parse_error *error, lmp_brdf_table **table);
lmp_result __wrap_lmp_brdf_read_rgl(const lmp_host *host, const void *data, size_t size,
                                    lmp_parse_error *error, lmp_brdf **brdf);

static pid_t tester;

lmp_result __wrap_lmp_brdf_read_merl(const lmp_host *host, const void *data, size_t size,
                                     lmp_parse_error *error, lmp_brdf **brdf) {
    if (size == 5)
        raise(SIGSEGV);
    return __real_lmp_brdf_read_merl(host, data, size, error, brdf);
}

/* Acts as a hole in the reader would for whoever made the file. */
lmp_result __wrap_lmp_brdf_table_read(const lmp_host *host, const void *data, size_t size,
                                      lmp_parse_error *error, lmp_brdf_table **table) {
    (void)host;
    (void)data;
    (void)size;
    (void)error;
    *table = NULL;
    if (getpid() == tester)
        fail_msg("the program itself reads what no child could");
    for (volatile int forever = 1; forever;)
        continue;
    return LMP_OK;
}

/* The first reading, in the child, succeeds. */
lmp_result __wrap_lmp_brdf_read_rgl(const lmp_host *host, const void *data, size_t size,
                                    lmp_parse_error *error, lmp_brdf **brdf) {
    (void)data;
    (void)size;
    (void)error;
    return lmp_brdf_create_lambert(host, (lmp_rgb) { 1, 1, 1 }, brdf);
}

static void expect_error(const char *name, const char *expected) {
    char path[64];
    material m;
    base_error error = { "" };
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_false(material_open(path, &m, &error));
    if (!strstr(error.text, expected))
        fail_msg("\"%s\" is not \"%s\"", error.text, expected);
}

static void a_crash_of_a_reader_is_an_error(void **state) {
    (void)state;
    folder_write_text("crash.binary", "crash");
    expect_error("crash.binary", "its reader crashed on it");
}

static void a_reader_that_never_ends_is_ended(void **state) {
    (void)state;
    folder_write_text("endless.lmpt", "LMPT");
    expect_error("endless.lmpt", "takes too long");
}

static void what_is_wrong_is_said_as_before(void **state) {
    (void)state;
    folder_write_text("short.binary", "short file");
    expect_error("short.binary", "a MERL file begins with 12 bytes of dimensions, this has 10");
}

static void what_a_child_could_read_is_read(void **state) {
    (void)state;
    char path[64];
    material m;
    base_error error;
    folder_write_text("white.bsdf", "tensor_file");
    snprintf(path, sizeof path, "%s/white.bsdf", folder);
    assert_true(material_open(path, &m, &error));
    assert_non_null(m.brdf);
    assert_int_equal(m.file_size, 11);
    material_close(&m);
}

static void numbers_are_all_that_comes_of_a_table_of_fits(void **state) {
    (void)state;
    char row[1024] = "x,cloth", name[128];
    material m;
    base_error error;
    for (int i = 0; i < 33; i++)
        snprintf(row + strlen(row), sizeof row - strlen(row), ",%g", 0.1 + 0.01 * i);
    folder_write_text("fits.csv", row);
    snprintf(name, sizeof name, "sgd:%s/fits.csv:cloth", folder);
    if (!material_open(name, &m, &error))
        fail_msg("%s", error.text);
    assert_non_null(m.brdf);
    material_close(&m);
    snprintf(name, sizeof name, "sgd:%s/fits.csv:silk", folder);
    assert_false(material_open(name, &m, &error));
    assert_non_null(strstr(error.text, "no material silk in this table"));
}

static int make_folder(void **state) {
    (void)state;
    tester = getpid();
    return mkdtemp(folder) ? 0 : 1;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_crash_of_a_reader_is_an_error),
        cmocka_unit_test(a_reader_that_never_ends_is_ended),
        cmocka_unit_test(what_is_wrong_is_said_as_before),
        cmocka_unit_test(what_a_child_could_read_is_read),
        cmocka_unit_test(numbers_are_all_that_comes_of_a_table_of_fits),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
