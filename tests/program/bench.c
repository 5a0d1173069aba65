/* SPDX-License-Identifier: MIT */
/* lampion bench: its options choose rows, which are JSON. No time is judged. */
#include "tests/program/folder.h"

#include <jansson.h>
#include <sys/wait.h>

/* A triangle, whose name needs escapes in JSON. */
#define OWN_SCENE "a\"b.obj"
#define TINY      "--json --size 16x16 "

/* Runs `lampion bench` of cpu or gpu with arguments for the shell, in which $F is the folder;
 * returns its status. */
static int bench_of(const char *what, const char *arguments) {
    char command[1024];
    snprintf(command, sizeof command, "F='%s'; \"$LAMPION_PROGRAM\" bench %s %s >$F/out 2>$F/err",
             folder, what, arguments);
    const int status = system(command);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static int bench(const char *arguments) {
    return bench_of("gpu", arguments);
}

static char *read_output(const char *name) {
    FILE *file = fopen(in_folder(name), "rb");
    char *text = calloc(1 << 16, 1);
    assert_non_null(file);
    assert_non_null(text);
    const size_t length = fread(text, 1, (1 << 16) - 1, file);
    assert_true(length < (1 << 16) - 1 && !ferror(file));
    fclose(file);
    return text;
}

/* Returns the whole output; its rows have every key. */
static json_t *rows_of(const char *arguments) {
    static const char *const numbers[] = {
        "bands",
        "lights",
        "width",
        "height",
        "ms",
        "frame_ms",
        "ns_per_pixel_light",
        "compile_ms",
        "table_bytes",
        "table_ms",
        "lobes_ms",
        "preintegrated_ms",
    };
    if (bench(arguments) != 0)
        fail_msg("%s: %s", arguments, read_output("err"));
    char *text = read_output("out");
    json_t *root = json_loads(text, 0, NULL);
    if (!root)
        fail_msg("%s: no JSON: %s", arguments, text);
    free(text);
    json_t *rows = json_object_get(root, "rows"), *row;
    size_t number;
    json_array_foreach (rows, number, row) {
        for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
            assert_true(json_is_number(json_object_get(row, numbers[i])));
        assert_true(json_number_value(json_object_get(row, "ms")) > 0);
        const double frames = json_number_value(json_object_get(row, "frames"));
        assert_true(frames >= 1 && frames <= 9);
        assert_non_null(json_object_get(row, "vs_paper"));
    }
    return root;
}

static int count_rows(json_t *root) {
    return (int)json_array_size(json_object_get(root, "rows"));
}

/* Counts the values that a key has in all rows; rows with the same value follow one another. */
static int count_values(json_t *root, const char *key) {
    int count = 0;
    json_t *rows = json_object_get(root, "rows"), *row, *before = NULL;
    size_t i;
    json_array_foreach (rows, i, row) {
        json_t *value = json_object_get(row, key);
        count += !before || !json_equal(value, before);
        before = value;
    }
    return count;
}

static json_t *row_at(json_t *root, int row) {
    return json_array_get(json_object_get(root, "rows"), (size_t)row);
}

static double number_at(json_t *root, int row, const char *key) {
    return json_number_value(json_object_get(row_at(root, row), key));
}

static const char *text_at(json_t *root, int row, const char *key) {
    return json_string_value(json_object_get(row_at(root, row), key));
}

static void a_setting_has_a_row_of_each_method(void **state) {
    (void)state;
    json_t *root = rows_of(TINY "--scene $F/a\\\"b.obj --bands 3 --lights 2");
    assert_int_equal(count_rows(root), 9);
    assert_string_equal(text_at(root, 0, "scene"), in_folder(OWN_SCENE));
    assert_string_equal(text_at(root, 0, "method"), "paper");
    assert_true(number_at(root, 0, "vs_paper") == 1);
    assert_true(number_at(root, 8, "bands") == 3 && number_at(root, 8, "lights") == 2);
    assert_int_equal(json_array_size(json_object_get(root, "materials")), 0);
    json_decref(root);
}

/* Paper and tabulated Z do not shade materials; the other methods include their tables. */
static void materials_are_in_the_rows(void **state) {
    (void)state;
    const char *const chosen = TINY "--scene $F/a\\\"b.obj --bands 3 --lights 2 --device cpu ";
    char arguments[256];
    snprintf(arguments, sizeof arguments, "%s--material 'wall=phong:5'", chosen);
    json_t *without = rows_of(chosen), *with = rows_of(arguments);
    assert_int_equal(count_rows(without), 3);
    assert_int_equal(count_rows(with), 3);
    for (int i = 0; i < 3; i++) {
        assert_true(number_at(with, i, "table_bytes") > number_at(without, i, "table_bytes"));
        assert_true(number_at(with, i, "table_ms") > 0 && number_at(without, i, "table_ms") <= 0);
        assert_int_equal(number_at(with, i, "lobes_ms") > 0, i == 1);
        assert_int_equal(number_at(with, i, "preintegrated_ms") > 0, i == 1);
    }
    assert_string_equal(json_string_value(json_array_get(json_object_get(with, "materials"), 0)),
                        "wall=phong:5");
    json_decref(without);
    json_decref(with);
    with = rows_of(TINY "--scene $F/a\\\"b.obj --bands 3 --lights 2 --device gpu --material "
                        "'wall=phong:5'");
    assert_int_equal(count_rows(with), 4);
    assert_string_equal(text_at(with, 0, "method"), "zonal");
    assert_true(json_is_null(json_object_get(row_at(with, 0), "vs_paper")));
    json_decref(with);
}

/* The short selection, and the rows that --full adds where options do not fix them. */
static void options_fix_what_the_rows_are_of(void **state) {
    static const struct {
        const char *options;
        int rows, scenes, bands, lights;
    } choices[] = {
        { "--scene $F/a\\\"b.obj", 10, 1, 7, 5 }, /* 30 lights, then others of 8 bands */
        { "--scene $F/a\\\"b.obj --bands 8", 1, 1, 1, 1 },
        { "--scene $F/a\\\"b.obj --lights 4", 6, 1, 6, 1 },
        { "--scene $F/a\\\"b.obj --bands 8 --lights 4,9,2", 3, 1, 1, 3 },
        { "--full --scene $F/a\\\"b.obj", 36, 1, 12, 31 },
        { "--full --scene $F/a\\\"b.obj --bands 2", 6, 1, 1, 6 },
        { "--full --scene $F/a\\\"b.obj --lights 4", 6, 1, 6, 1 },
        { "--full --bands 2 --lights 1", 2, 2, 1, 1 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof choices / sizeof *choices; i++) {
        char arguments[256];
        snprintf(arguments, sizeof arguments, TINY "--device cpu --method zonal %s",
                 choices[i].options);
        json_t *root = rows_of(arguments);
        if (count_rows(root) != choices[i].rows ||
            count_values(root, "scene") != choices[i].scenes ||
            count_values(root, "bands") != choices[i].bands ||
            count_values(root, "lights") != choices[i].lights)
            fail_msg("%s: %d rows of %d scenes, %d bands, %d lights", choices[i].options,
                     count_rows(root), count_values(root, "scene"), count_values(root, "bands"),
                     count_values(root, "lights"));
        json_decref(root);
    }
}

/* Rows hold the field, and what it is compared with, for all numbers of lights; each row ends with
 * a line. */
static void several_numbers_of_lights_make_a_table_of_whole_frames(void **state) {
    (void)state;
    const char *const list = "--size 16x16 --scene $F/a\\\"b.obj --device cpu --bands 3 "
                             "--lights 3,20";
    char json[256];
    snprintf(json, sizeof json, "--json %s", list);
    json_t *root = rows_of(json);
    const char *const methods[] = { "zonal", "field", "zonal", "field", "preintegrated" };
    assert_int_equal(count_rows(root), 6);
    for (int i = 0; i < 5; i++)
        assert_string_equal(text_at(root, i, "method"), methods[i]);
    assert_true(number_at(root, 2, "lights") == 20 && number_at(root, 4, "lights") == 3);
    json_decref(root);
    assert_int_equal(bench(list), 0);
    char *text = read_output("out"), *table = strstr(text, "\nwhole frames, 3 bands, 16x16: ms");
    assert_non_null(table);
    assert_true(strstr(table, "\n     3  ") && strstr(table, "\n    20  "));
    free(text);
}

/* With the paper's 8 bands and 30 lights; the rows left out are reported. */
static void the_most_telling_rows_come_first_while_there_is_time(void **state) {
    (void)state;
    json_t *all = rows_of(TINY "--scene $F/a\\\"b.obj --time 1");
    char *said = read_output("err");
    const int count = count_rows(all);
    assert_true(count >= 1);
    assert_true(number_at(all, 0, "bands") == 8 && number_at(all, 0, "lights") == 30);
    assert_string_equal(text_at(all, 0, "method"), "paper");
    if (count < 69) /* all rows */
        assert_non_null(strstr(said, "rows left out for want of time"));
    free(said);
    json_decref(all);
}

/* The rows have the most bands that fields take. */
static void fields_have_rows_of_updates_and_of_points(void **state) {
    (void)state;
    static const char *const kernels[] = { "field-update", "shade-field" };
    for (int i = 0; i < 4; i++) {
        char arguments[128];
        snprintf(arguments, sizeof arguments,
                 "--json --kernel %s --bands %d --threads 1 --cpu-mask 2", kernels[i / 2],
                 i % 2 ? 11 : 3);
        assert_int_equal(bench_of("cpu", arguments), 0);
        char *text = read_output("out");
        json_t *root = json_loads(text, 0, NULL);
        assert_non_null(root);
        assert_int_equal(count_rows(root), i % 2 ? 0 : 1);
        json_decref(root);
        free(text);
    }
}

/* Kernels that do little but store, of 10 bands, have outputs for the first-level cache, the
 * second-level cache and memory. */
static void rows_say_where_their_outputs_fit(void **state) {
    (void)state;
    static const char *const sets[] = { "L1", "L2", "memory" };
    assert_int_equal(bench_of("cpu", "--json --kernel basis --bands 10 --threads 1 --cpu-mask 2"),
                     0);
    char *text = read_output("out");
    json_t *root = json_loads(text, 0, NULL);
    assert_non_null(root);
    assert_int_equal(count_rows(root), 6);
    json_t *rows = json_object_get(root, "rows"), *row;
    size_t number;
    int i = 0;
    json_array_foreach (rows, number, row) {
        json_t *set = json_object_get(row, "working_set");
        assert_string_equal(json_string_value(set), sets[i++ % 3]);
        assert_true(json_number_value(json_object_get(row, "stores_ns")) > 0);
    }
    json_decref(root);
    free(text);
}

/* A kernel without a scalar row has no ratio. */
static void kernels_without_scalar_rows_have_no_ratio_to_them(void **state) {
    (void)state;
    for (int scalar = 0; scalar < 2; scalar++) {
        char arguments[128];
        snprintf(arguments, sizeof arguments,
                 "--json --kernel zonal --bands 3 --threads 1 --cpu-mask %d", scalar ? 1 : 14);
        assert_int_equal(bench_of("cpu", arguments), 0);
        char *text = read_output("out");
        json_t *root = json_loads(text, 0, NULL);
        assert_non_null(root);
        json_t *rows = json_object_get(root, "rows"), *row;
        size_t number;
        json_array_foreach (rows, number, row) {
            json_t *ratio = json_object_get(row, "vs_scalar");
            assert_true(scalar ? json_is_number(ratio) : json_is_null(ratio));
        }
        assert_true(!scalar || count_rows(root) == 2);
        json_decref(root);
        free(text);
    }
}

static void bad_options_end_before_anything_runs(void **state) {
    static const struct {
        int status;
        const char *options;
    } refused[] = {
        { 2, "--method paper --bands 50" },
        { 2, "--device cpu --method paper" },
        { 2, "--method paper --scene $F/a\\\"b.obj --material wall=phong:5" },
        { 2, "--full --material wall=phong:5" },
        { 2, "--method polar" },
        { 2, "--device tpu" },
        { 2, "--lights 65537" },
        { 2, "--lights 4,0" },
        { 2, "--size 0x4" },
        { 1, "--scene $F/none.obj" },
        { 1, "--scene $F/a\\\"b.obj --material wall" },
        { 1, "--scene $F/a\\\"b.obj --material ball=phong:5" },
        { 1, "--scene $F/a\\\"b.obj --material wall=phong:x" },
    };
    (void)state;
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const int status = bench(refused[i].options);
        char *out = read_output("out"), *err = read_output("err");
        const char *end = strchr(err, '\n');
        if (status != refused[i].status || *out || !end || end[1] ||
            strncmp(err, "lampion", 7) != 0)
            fail_msg("%s: status %d, \"%s\", \"%s\"", refused[i].options, status, out, err);
        free(out);
        free(err);
    }
}

static int prepare(void **state) {
    (void)state;
    if (!mkdtemp(folder) || !getenv("LAMPION_PROGRAM"))
        return 1;
    /* llvmpipe's LLVM leaks and is unloaded before the check, so no suppression can name it */
    setenv("ASAN_OPTIONS", "detect_leaks=0", true);
    folder_write_text("a.mtl", "newmtl wall\nKd 0.5 0.5 0.5\n");
    folder_write_text(OWN_SCENE,
                      "mtllib a.mtl\nv -1 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\n");
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_setting_has_a_row_of_each_method),
        cmocka_unit_test(materials_are_in_the_rows),
        cmocka_unit_test(options_fix_what_the_rows_are_of),
        cmocka_unit_test(several_numbers_of_lights_make_a_table_of_whole_frames),
        cmocka_unit_test(the_most_telling_rows_come_first_while_there_is_time),
        cmocka_unit_test(fields_have_rows_of_updates_and_of_points),
        cmocka_unit_test(rows_say_where_their_outputs_fit),
        cmocka_unit_test(kernels_without_scalar_rows_have_no_ratio_to_them),
        cmocka_unit_test(bad_options_end_before_anything_runs),
    };
    return cmocka_run_group_tests(tests, prepare, folder_remove);
}
