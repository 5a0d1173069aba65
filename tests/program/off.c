/* SPDX-License-Identifier: MIT */
/* OFF: words that lines may hold in any arrangement. */
#include "app/scene/instance.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"
#include "tests/program/load.h"

#define QUAD "0 0 0\n1 0 0\n1 1 0\n0 1 0\n"

static void words_stand_on_any_line(void **state) {
    (void)state;
    static const char *const files[] = {
        "OFF\n4 1 0\n" QUAD "4 0 1 2 3\n",
        " \tOFF4 1 0\n" QUAD "4 0 1 2 3\n",
        "OFF 4 1 0 # a comment\n\n" QUAD "4 0 1 2 3",
        "OFF\r\n4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3\r\n",
        "OFF\n4\n1\n0\n" QUAD "4 0\n1\n2\n3\n",
        "COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 1 0 0\n1 1 0 9\n0 1 0\n4 0 1 2 3 0.5 0.5 0.5\n",
        "STOFF\n4 2 0\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n2 0 1\n",
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        folder_write_text("m.off", files[i]);
        scene s = load(in_folder("m.off"));
        assert_int_equal(scene_triangle_count(&s), 2);
        CHECK_WITHIN(fabs(scene_area(&s) - 1), 1e-6);
        assert_unit_and_inside(&s);
        scene_free(&s);
    }
}

static void normals_are_those_of_the_file(void **state) {
    (void)state;
    folder_write_text("n.off", "NOFF\n3 1 0\n0 0 0 0 0.6 0.8\n1 0 0 0 3 4\n0 1 0 0 0.6 0.8\n"
                               "3 0 1 2\n");
    scene s = load(in_folder("n.off"));
    for (size_t i = 0; i < s.vertex_count; i++)
        CHECK_WITHIN(fabs((double)s.vertices[i].normal[1] - 0.6), 1e-6);
    scene_free(&s);
}

static void what_is_no_off_is_refused(void **state) {
    (void)state;
    static const struct {
        const char *text, *said;
    } files[] = {
        { "4OFF\n4 1 0\n", "line 1 does not begin with OFF" },
        { "OFF\n4 one 0\n", "line 2 has no whole number" },
        { "OFF\n400 1 0\n" QUAD, "line 2 counts more vertices than bytes" },
        { "OFF\n4 1 0\n" QUAD, "line 7 is the last, before its elements" },
        { "OFF\n4 1 0\n0 0 zero\n1 0 0\n1 1 0\n0 1 0\n", "line 3 has no finite number" },
        { "OFF\n4 1 0\n" QUAD "3 0 1 4\n", "line 7 has a face with a vertex that does not exist" },
        { "OFF\n4 1 0\n" QUAD "3 0 1 -1\n", "line 7 has no whole number" },
        { "OFF\n4 0 0\n" QUAD, "has no triangles" },
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        scene s;
        base_error error = { "" };
        folder_write_text("bad.off", files[i].text);
        assert_false(
            scene_load(in_folder("bad.off"), &(scene_options) { .no_cache = true }, &s, &error));
        if (!strstr(error.text, files[i].said))
            fail_msg("%s", error.text);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_stand_on_any_line),
        cmocka_unit_test(normals_are_those_of_the_file),
        cmocka_unit_test(what_is_no_off_is_refused),
    };
    return cmocka_run_group_tests(tests, folder_make, folder_remove);
}
