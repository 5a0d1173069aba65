/* SPDX-License-Identifier: MIT */
/* A screenshot repeated by the program asks for no more than its user allows, however small it is
 * itself. */
#include "app/image/png.h"
#include "tests/program/refused.h"
#include "tests/program/view.h"

#include "app/file/file.h"

/* An image of one pixel whose settings ask for so many. */
static void write_shot(const char *name, int width, int height) {
    static const unsigned char pixel[3];
    cli_error error;
    state.now.width = width;
    state.now.height = height;
    state.now.samples = 1;
    char *text = file_json_text(view_settings_to_json(&state.now), false, name, &error);
    assert_non_null(text);
    if (!image_write_png8_text(pixel, 1, 1, &(image_text) { "lampion", text }, in_folder(name),
                               &error))
        fail_msg("%s", error.text);
    free(text);
}

/* Runs `lampion render --from NAME -o out.png --max-pixels N`, or without the last. */
static int repeat(const char *name, const char *pixels_max) {
    char shot[64], output[64];
    snprintf(shot, sizeof shot, "%s/%s", folder, name);
    snprintf(output, sizeof output, "%s/out.png", folder);
    unlink(output);
    const char *const arguments[] = { "lampion", "render",       "--from",   shot, "-o",
                                      output,    "--max-pixels", pixels_max, NULL };
    const char *const usual[] = { "lampion", "render", "--from", shot, "-o", output, NULL };
    return run_program(pixels_max ? arguments : usual);
}

static void large_ones_are_refused_unless_allowed(void **unused) {
    (void)unused;
    write_shot("large.png", 8192, 8192);
    assert_one_line(repeat("large.png", NULL), "large.png", "asks for 8192 x 8192 pixels");
    assert_int_not_equal(access(in_folder("out.png"), F_OK), 0);
    write_shot("small.png", 40, 30);
    assert_one_line(repeat("small.png", "1199"), "small.png", "(at most 1199; see --max-pixels)");
    assert_int_equal(repeat("small.png", "1200"), 0);
    assert_int_equal(access(in_folder("out.png"), F_OK), 0);
}

/* Before a window is opened: without a display it is known, too. */
static void the_viewer_refuses_the_same(void **unused) {
    (void)unused;
    char shot[64];
    write_shot("large.png", 8192, 8192);
    snprintf(shot, sizeof shot, "%s/large.png", folder);
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    assert_one_line(run_program((const char *[]) { "lampion", "view", "--from", shot, NULL }), shot,
                    "asks for 8192 x 8192 pixels (at most 33554432; see --max-pixels)");
    const char *const allowed[] = { "lampion",      "view",     "--from", shot,
                                    "--max-pixels", "67108864", NULL };
    assert_one_line(run_program(allowed), shot, "display");
}

/* A file that is standard input, by its other names, as the screenshot's scene or a material of it.
 */
static void none_reads_standard_input(void **unused) {
    (void)unused;
    static const char *const names[] = { "/dev/stdin", "/dev/fd/0", "/proc/self/fd/0",
                                         "/proc/thread-self/fd/0" };
    const char *const expected = "is standard input, which is read by the name - alone";
    folder_write_text("input", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const int input = open(in_folder("input"), O_RDONLY);
    assert_int_equal(dup2(input, STDIN_FILENO), STDIN_FILENO);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        strcpy(state.now.scene, names[i]);
        write_shot("scene.png", 8, 8);
        assert_one_line(repeat("scene.png", NULL), names[i], expected);
        strcpy(state.now.scene, "builtin:ball");
        assert_true(view_set_material(&state.now, "test_material", names[i]));
        write_shot("material.png", 8, 8);
        assert_one_line(repeat("material.png", NULL), names[i], expected);
        assert_true(view_set_material(&state.now, "test_material", NULL));
    }
    close(input);
}

int main(void) {
    const struct CMUnitTest tests[] = { TEST(large_ones_are_refused_unless_allowed),
                                        TEST(the_viewer_refuses_the_same),
                                        TEST(none_reads_standard_input) };
    return cmocka_run_group_tests(tests, make_refused_folder, folder_remove);
}
