/* SPDX-License-Identifier: MIT */
/* Option tables, strict numbers, one-line errors: app/base/cli.h. */
#include "app/base/cli.h"
#include "app/base/printable.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const methods[] = { "zonal", "coefficients", NULL };
static const cli_command command = { "draw", "SCENE", "draws", "lampion draw", NULL, true };

/* Everything a table can hold. */
typedef struct values {
    bool verbose, eye_given;
    int bands, size[2], grid[3], method, frames[2], part[2];
    uint64_t seed;
    float fov, eye[3];
    const char *output;
    cli_list lights;
    cli_numbers counts;
} values;

typedef struct outcome {
    values values;
    bool go_on;
    int status, operand_count;
    char **operands;
    char printed[4096], complaint[2048];
} outcome;

/* Runs `call` with a standard stream going to `text`. */
static int divert(FILE *stream, int descriptor, FILE *file) {
    fflush(stream);
    const int saved = dup(descriptor);
    assert_true(saved >= 0 && dup2(fileno(file), descriptor) >= 0);
    return saved;
}

static void restore(FILE *stream, int descriptor, int saved, FILE *file, char *text, size_t size) {
    fflush(stream);
    dup2(saved, descriptor);
    close(saved);
    rewind(file);
    text[fread(text, 1, size - 1, file)] = '\0';
    fclose(file);
}

static outcome parse(int argc, char **argv) {
    outcome o = { .values = { .bands = 8, .size = { 640, 480 }, .seed = 1, .fov = 0.5f } };
    values *v = &o.values;
    const cli_option options[] = {
        { "verbose", 'v', CLI_FLAG, &v->verbose, NULL, "say more", 0, 0, NULL, NULL },
        { "bands", 'n', CLI_INT, &v->bands, "N", "bands", 1, 128, NULL, NULL },
        { "size", 0, CLI_SIZE, &v->size, "WxH", "pixels", 1, 16384, NULL, NULL },
        { "grid", 0, CLI_GRID, v->grid, "XxYxZ", "nodes", 2, 99, NULL, NULL },
        { "seed", 0, CLI_SEED, &v->seed, "N", "seed", 0, 0, NULL, NULL },
        { "fov", 0, CLI_FLOAT, &v->fov, "R", "field of view", 0.01, 3.1, NULL, NULL },
        { "eye", 0, CLI_VEC3, v->eye, "X,Y,Z", "position", 0, 0, NULL, &v->eye_given },
        { "method", 0, CLI_CHOICE, &v->method, "NAME", "method", 0, 0, methods, NULL },
        { "output", 'o', CLI_TEXT, &v->output, "FILE", "image", 0, 0, NULL, NULL },
        { "frames", 0, CLI_RANGE, v->frames, "N|A-B", "frames", 0, 99, NULL, NULL },
        { "part", 0, CLI_PART, v->part, "I/N", "part", 1, 99, NULL, NULL },
        { "counts", 0, CLI_NUMBERS, &v->counts, "N,N", "counts", 1, 99, NULL, NULL },
        { "lights", 0, CLI_LIST, &v->lights, "FILE", "lights", 0, 0, NULL, NULL },
        { NULL, 0, CLI_FLAG, NULL, NULL, NULL, 0, 0, NULL, NULL },
    };
    FILE *const out = tmpfile(), *const err = tmpfile();
    const int saved_out = divert(stdout, STDOUT_FILENO, out);
    const int saved_err = divert(stderr, STDERR_FILENO, err);
    o.go_on = cli_parse(&command, options, argc, argv, &o.operand_count, &o.operands, &o.status);
    restore(stdout, STDOUT_FILENO, saved_out, out, o.printed, sizeof o.printed);
    restore(stderr, STDERR_FILENO, saved_err, err, o.complaint, sizeof o.complaint);
    return o;
}

/* Parses the words of a command line; the words live as long as the program. */
#define PARSE(...)                                                                                 \
    parse((int)(sizeof(const char *[]) { "draw", __VA_ARGS__ } / sizeof(char *)),                  \
          (char **)(uintptr_t)(const char *[]) { "draw", __VA_ARGS__, NULL })

static void every_kind_is_read_in_every_spelling(void **state) {
    (void)state;
    const outcome o =
        PARSE("--bands", "12", "a.gltf", "--size=1980x995", "--grid", "3x4x5", "-v", "-oout.png",
              "--seed=18446744073709551615", "--eye", "-1,2.5,3e-1", "--method", "coefficients",
              "--lights", "a", "--lights=b", "--", "--bands");
    assert_true(o.go_on);
    assert_string_equal(o.complaint, "");
    assert_int_equal(o.values.bands, 12);
    assert_int_equal(o.values.size[0], 1980);
    assert_int_equal(o.values.size[1], 995);
    for (int i = 0; i < 3; i++)
        assert_int_equal(o.values.grid[i], 3 + i);
    assert_true(o.values.verbose);
    assert_true(o.values.seed == UINT64_MAX);
    assert_true(o.values.eye_given);
    assert_true(o.values.eye[0] == -1.0f && o.values.eye[1] == 2.5f && o.values.eye[2] == 0.3f);
    assert_int_equal(o.values.method, 1);
    assert_string_equal(o.values.output, "out.png");
    assert_int_equal(o.values.lights.count, 2);
    assert_string_equal(o.values.lights.items[1], "b");
    assert_int_equal(o.operand_count, 2);
    assert_string_equal(o.operands[0], "a.gltf");
    assert_string_equal(o.operands[1], "--bands");
}

static void ranges_and_parts_are_read(void **state) {
    (void)state;
    outcome o = PARSE("--frames", "48", "--part", "3/8");
    assert_true(o.go_on);
    assert_true(o.values.frames[0] == 0 && o.values.frames[1] == 47);
    assert_true(o.values.part[0] == 3 && o.values.part[1] == 8);
    o = PARSE("--frames=7-99");
    assert_true(o.go_on && o.values.frames[0] == 7 && o.values.frames[1] == 99);
    o = PARSE("--frames=7-7");
    assert_true(o.go_on && o.values.frames[0] == 7 && o.values.frames[1] == 7);
}

static void lists_of_numbers_are_read(void **state) {
    (void)state;
    outcome o = PARSE("--counts", "10,99,1");
    assert_true(o.go_on && o.values.counts.count == 3);
    assert_true(o.values.counts.values[0] == 10 && o.values.counts.values[1] == 99 &&
                o.values.counts.values[2] == 1);
    o = PARSE("--counts=1,2", "--counts=7");
    assert_true(o.go_on && o.values.counts.count == 1 && o.values.counts.values[0] == 7);
    o = PARSE("--counts", "1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16");
    assert_true(o.go_on && o.values.counts.count == CLI_NUMBERS_MAX);
}

static void absent_options_keep_their_defaults(void **state) {
    (void)state;
    const outcome o = PARSE("-");
    assert_true(o.go_on);
    assert_int_equal(o.values.bands, 8);
    assert_false(o.values.eye_given);
    assert_int_equal(o.operand_count, 1);
}

static void wrong_values_are_refused_in_one_line(void **state) {
    (void)state;
    static const char *const wrong[][2] = {
        { "--bands=0", "out of range (1 to 128)" },
        { "--bands=129", "out of range" },
        { "--bands=8x", "not a whole number" },
        { "--bands= 8", "not a whole number" },
        { "--bands=1e1", "not a whole number" },
        { "--bands=", "not a whole number" },
        { "--bands=99999999999999999999", "out of range" },
        { "--fov=nan", "not a number" },
        { "--fov=inf", "not a number" },
        { "--fov=1e999", "not a number" },
        { "--fov=0x1", "not a number" },
        { "--fov=1,5", "not a number" },
        { "--fov=3.2", "out of range" },
        { "--eye=1,2", "three numbers" },
        { "--eye=1,2,3,4", "three numbers" },
        { "--eye=1,,3", "three numbers" },
        { "--eye=1,2,1e39", "out of range" },
        { "--size=640", "a size" },
        { "--size=640x", "a size" },
        { "--size=0x480", "out of range" },
        { "--size=640x-1", "a size" },
        { "--grid=3x4", "a grid" },
        { "--grid=3x4x5x6", "a grid" },
        { "--grid=3,4,5", "a grid" },
        { "--grid=3x1x5", "out of range (2 to 99)" },
        { "--seed=-1", "whole number" },
        { "--seed=18446744073709551616", "whole number" },
        { "--method=fast", "not one of zonal, coefficients" },
        { "--frames=0", "out of range" },
        { "--frames=101", "out of range (0 to 99)" },
        { "--frames=0-100", "out of range" },
        { "--frames=5-4", "neither a count" },
        { "--frames=-4", "neither a count" },
        { "--frames=1-", "neither a count" },
        { "--frames=1-2-3", "neither a count" },
        { "--part=0/3", "not a part" },
        { "--part=4/3", "not a part" },
        { "--part=3", "not a part" },
        { "--part=1/100", "out of range (1 to 99)" },
        { "--counts=", "not a list" },
        { "--counts=1,", "not a list" },
        { "--counts=1,,2", "not a list" },
        { "--counts=1,2.5", "not a list" },
        { "--counts=1,100", "out of range (1 to 99)" },
        { "--counts=1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1,1", "more than 16 numbers" },
        { "--verbose=1", "takes no value" },
        { "--output", "needs a value" },
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        const outcome o = PARSE(wrong[i][0]);
        assert_false(o.go_on);
        assert_int_equal(o.status, BASE_USAGE);
        if (!strstr(o.complaint, wrong[i][1]))
            fail_msg("%s: %s", wrong[i][0], o.complaint);
        assert_ptr_equal(strchr(o.complaint, '\n'), o.complaint + strlen(o.complaint) - 1);
    }
}

static void a_forgotten_value_does_not_eat_the_next_option(void **state) {
    (void)state;
    const outcome o = PARSE("-o", "--bands", "3");
    assert_int_equal(o.status, BASE_USAGE);
    assert_non_null(strstr(o.complaint, "--output needs a value: --output FILE"));
}

static void unknown_options_name_the_nearest(void **state) {
    (void)state;
    assert_non_null(strstr(PARSE("--band", "3").complaint, "did you mean --bands?"));
    assert_non_null(strstr(PARSE("--szie=3x3").complaint, "--szie (did you mean --size?)"));
    assert_non_null(strstr(PARSE("--width", "3").complaint, "--width (did you mean --size?)"));
    assert_null(strstr(PARSE("--hdri", "a").complaint, "did you mean")); /* has no environment */
    assert_non_null(strstr(PARSE("--hlep").complaint, "did you mean --help?"));
    assert_null(strstr(PARSE("--xylophone").complaint, "did you mean"));
    assert_non_null(strstr(PARSE("-x").complaint, "unknown option -x"));
    assert_null(strstr(PARSE("-\x1b[31m").complaint, "\x1b"));
}

static void help_shows_defaults_ranges_and_examples(void **state) {
    (void)state;
    const outcome o = PARSE("--bands", "3", "--nonsense", "--help");
    assert_false(o.go_on);
    assert_int_equal(o.status, BASE_OK);
    static const char *const expected[] = {
        "lampion draw: draws", "lampion draw [OPTION…] SCENE",
        "-n, --bands N",       "1 to 128 [8]",
        "[640x480]",           "zonal, coefficients [zonal]",
        "-o, --output FILE",   "  lampion draw\n",
    };
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++)
        if (!strstr(o.printed, expected[i]))
            fail_msg("no \"%s\" in:\n%s", expected[i], o.printed);
}

static void what_a_terminal_obeys_is_not_printable(void **state) {
    (void)state;
    static const char *const shown[] = { "a",
                                         "~",
                                         "\xC3\xBC",
                                         "\xE2\x98\x83",
                                         "\xF0\x9F\x8F\xAE",
                                         "\xC2\xA0",
                                         "\xED\x9F\xBF",
                                         "\xEE\x80\x80" };
    /* controls; C1 as UTF-8 and as a byte; changes of direction; truncated, overlong, surrogate,
     * out of range */
    static const char *const obeyed[] = {
        "\n",           "\x1b",
        "\x7f",         "\xC2\x9B",
        "\x9B",         "\xE2\x80\xAE",
        "\xE2\x81\xA6", "\xE2\x80\x8F",
        "\xC3",         "\xE2\x98",
        "\xC0\xAF",     "\xE0\x80\xAF",
        "\xED\xA0\x80", "\xF4\x90\x80\x80",
        "\xFF",
    };
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        assert_int_equal(printable_length(shown[i]), strlen(shown[i]));
    for (size_t i = 0; i < sizeof obeyed / sizeof *obeyed; i++)
        assert_int_equal(printable_length(obeyed[i]), 0);
}

static void errors_are_one_line_free_of_control_characters(void **state) {
    (void)state;
    base_error error;
    assert_false(base_fail(&error, "a\nb\x1b[2J\xC2\x9B.gltf", "is %s (try %d)", "bad", 3));
    assert_string_equal(error.text, "a?b?[2J??.gltf: is bad (try 3)");
    char name[5000];
    memset(name, 'n', sizeof name);
    name[sizeof name - 1] = '\0';
    base_fail(&error, name, "is empty");
    assert_non_null(strstr(error.text, ": is empty"));
    base_fail(&error, NULL, "%s", name);
    assert_int_equal(strlen(error.text), sizeof error.text - 1);
}

static void too_many_list_items_are_refused(void **state) {
    (void)state;
    static char option[] = "--lights=x", name[] = "draw";
    char *argv[67] = { name };
    for (int i = 1; i < 66; i++)
        argv[i] = option;
    assert_true(parse(65, argv).go_on);
    assert_non_null(strstr(parse(66, argv).complaint, "more than 64 times"));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_is_read_in_every_spelling),
        cmocka_unit_test(ranges_and_parts_are_read),
        cmocka_unit_test(lists_of_numbers_are_read),
        cmocka_unit_test(absent_options_keep_their_defaults),
        cmocka_unit_test(wrong_values_are_refused_in_one_line),
        cmocka_unit_test(a_forgotten_value_does_not_eat_the_next_option),
        cmocka_unit_test(unknown_options_name_the_nearest),
        cmocka_unit_test(help_shows_defaults_ranges_and_examples),
        cmocka_unit_test(what_a_terminal_obeys_is_not_printable),
        cmocka_unit_test(errors_are_one_line_free_of_control_characters),
        cmocka_unit_test(too_many_list_items_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
