/* SPDX-License-Identifier: MIT */
/* A screenshot repeated by the program needs no more than its user allows, however small it is
 * itself, and opens no file except those that came with it. */
#include "app/image/png.h"
#include "tests/program/refused.h"
#include "tests/program/view.h"

#include "app/base/error.h"
#include "app/base/file.h"
#include "app/base/file_json.h"

#include <errno.h>
#include <signal.h>
#include <sys/wait.h>

/* Writes an image of one pixel whose settings ask for a given size. */
static void write_shot(const char *name, int width, int height) {
    static const unsigned char pixel[3];
    base_error error;
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

/* Runs `lampion render --from NAME -o out.png`, then up to two more words. */
static int repeat_with(const char *name, const char *word, const char *other) {
    char shot[64], output[64];
    snprintf(shot, sizeof shot, "%s/%s", folder, name);
    snprintf(output, sizeof output, "%s/out.png", folder);
    unlink(output);
    return run_program(
        (const char *[]) { "lampion", "render", "--from", shot, "-o", output, word, other, NULL });
}

static int repeat(const char *name, const char *pixels_max) {
    return repeat_with(name, pixels_max ? "--max-pixels" : NULL, pixels_max);
}

/* Runs the viewer with the same words, which without a display gets as far as its window. */
static int look_with(const char *name, const char *word, const char *other) {
    char shot[64];
    snprintf(shot, sizeof shot, "%s/%s", folder, name);
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    return run_program((const char *[]) { "lampion", "view", "--from", shot, word, other, NULL });
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

/* The viewer refuses before it opens a window: without a display that shows, too. */
static void the_viewer_refuses_the_same(void **unused) {
    (void)unused;
    write_shot("large.png", 8192, 8192);
    assert_one_line(look_with("large.png", NULL, NULL), "large.png",
                    "asks for 8192 x 8192 pixels (at most 33554432; see --max-pixels)");
    assert_one_line(look_with("large.png", "--max-pixels", "67108864"), "large.png", "display");
}

/* The tables of both sides are measured before one is made, which the cache would show. */
static void tables_too_large_for_a_gpu_are_not_made(void **unused) {
    (void)unused;
    char command[600];
    state.now.split = GPU_SPLIT_DIVIDED;
    state.now.shading[1] = (view_shading) { METHOD_COEFFICIENTS, 20, LMP_WINDOW_NONE };
    assert_true(view_set_material(&state.now, "test_material", "ggx:0.8x0.7"));
    write_shot("tables.png", 8, 8);
    assert_one_line(repeat("tables.png", NULL), "two sides",
                    "the tables of the materials are too large (fewer --bands)");
    snprintf(command, sizeof command, "find '%s' -name '*.lmpt' | grep -q .", in_folder("cache"));
    assert_int_not_equal(system(command), 0);
}

/* Standard input by its other names is refused as the screenshot's scene or a material of it. */
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
        assert_one_line(repeat_with("scene.png", "--allow-paths", NULL), names[i], expected);
        strcpy(state.now.scene, "builtin:ball");
        assert_true(view_set_material(&state.now, "test_material", names[i]));
        write_shot("material.png", 8, 8);
        assert_one_line(repeat_with("material.png", "--allow-paths", NULL), names[i], expected);
        assert_true(view_set_material(&state.now, "test_material", NULL));
    }
    close(input);
}

/* --- names of files --------------------------------------------------------------------------- */

#define MATERIAL_TEXT(name) "test_material=" name

/* The parts of a screenshot that are names of files, with the text before and after one. */
typedef struct part {
    const char *name; /* name in messages */
    const char *beginning, *end;
} part;
static const part parts[] = { { "scene", "", "" },
                              { "environment", "", "" },
                              { "material", "", "" },
                              { "material", "sgd:", ":nickel" } };

/* Writes a screenshot in the folder `shots` with a name in one of its parts. */
static void write_part(const part *p, const char *file) {
    char text[512];
    snprintf(text, sizeof text, "%s%s%s", p->beginning, file, p->end);
    strcpy(state.now.scene, strcmp(p->name, "scene") == 0 ? text : "builtin:ball");
    strcpy(state.now.environment.name, strcmp(p->name, "environment") == 0 ? text : "none");
    const char *const material = strcmp(p->name, "material") == 0 ? text : NULL;
    assert_true(view_set_material(&state.now, "test_material", material));
    write_shot("shots/shot.png", 8, 8);
}

/* Writes the same file in the folder, below it and in another, and links that stay inside and that
 * lead out. */
static void write_files(void) {
    static const char *const folders[] = { "shots", "shots/below", "shots2" };
    for (size_t i = 0; i < sizeof folders / sizeof *folders; i++) {
        char name[64];
        mkdir(in_folder(folders[i]), 0700);
        snprintf(name, sizeof name, "%s/room.obj", folders[i]);
        folder_write_text(name, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    }
    static const char *const links[][2] = { { "../shots2", "shots/out" },
                                            { "../shots2/room.obj", "shots/file.obj" },
                                            { "../shots2/none.obj", "shots/dangling.obj" },
                                            { "chain2", "shots/chain" },
                                            { "/etc", "shots/chain2" },
                                            { "below", "shots/in" },
                                            { "shots", "alias" },
                                            { "ring", "shots/ring" } };
    for (size_t i = 0; i < sizeof links / sizeof *links; i++)
        assert_true(symlink(links[i][0], in_folder(links[i][1])) == 0 || errno == EEXIST);
    assert_int_equal(chdir(in_folder("shots")), 0);
}

/* Names are refused whether or not there is such a file, and before any of it is read. */
static void names_that_lead_out_are_refused(void **unused) {
    (void)unused;
    char absolute[64];
    snprintf(absolute, sizeof absolute, "%s/shots2/room.obj", folder);
    const char *const names[] = { absolute,
                                  "../shots2/room.obj",
                                  "../none.obj",
                                  "below/../../shots2/room.obj",
                                  "file.obj",
                                  "out/room.obj",
                                  "dangling.obj",
                                  "chain/passwd",
                                  "in/../../x",
                                  "/etc/passwd",
                                  "/dev/null",
                                  "/net/host/share/room.obj",
                                  "/proc/self/mem",
                                  "none/../../shots2/room.obj",
                                  "ring",
                                  "..",
                                  "out/../shots/room.obj" };
    write_files();
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (size_t k = 0; k < (i == 0 ? sizeof names / sizeof *names : 8); k++) {
            char expected[256];
            snprintf(expected, sizeof expected,
                     "shots/shot.png: names the %s \"%s\", which is outside its folder (see "
                     "--allow-paths)",
                     parts[i].name, names[k]);
            write_part(&parts[i], names[k]);
            assert_one_line(repeat("shots/shot.png", NULL), names[k], expected);
            assert_one_line(look_with("shots/shot.png", NULL, NULL), names[k], expected);
        }
}

/* Names that stay inside reach the reader of such files, which reports errors if there are any. */
static void names_that_stay_are_opened(void **unused) {
    (void)unused;
    char absolute[64], alias[64];
    snprintf(absolute, sizeof absolute, "%s/shots/room.obj", folder);
    snprintf(alias, sizeof alias, "%s/alias/below/room.obj", folder);
    const char *const names[] = { absolute,          alias,         "room.obj",
                                  "below//room.obj", "in/room.obj", "./below/../room.obj",
                                  "none.obj" };
    write_files();
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        for (size_t k = i % 2; k < sizeof names / sizeof *names; k += i == 0 ? 1 : 3) {
            char text[4096];
            write_part(&parts[i], names[k]);
            const bool drawn = i == 0 && strcmp(names[k], "none.obj") != 0;
            assert_int_equal(repeat("shots/shot.png", NULL), drawn ? 0 : 1);
            read_text("stderr", text, sizeof text);
            if (strstr(text, "--allow-paths") || (!drawn && !strstr(text, names[k])))
                fail_msg("%s, %s: %s", parts[i].name, names[k], text);
        }
}

/* The file is named through a link to the folder, from another folder. */
static void the_folder_is_where_the_file_lies(void **unused) {
    (void)unused;
    write_files();
    write_part(&parts[0], "../shots/room.obj");
    assert_int_equal(repeat("alias/shot.png", NULL), 0);
    assert_int_equal(chdir(in_folder("shots2")), 0);
    assert_int_equal(repeat("shots/shot.png", NULL), 0);
    write_part(&parts[0], "room.obj"); /* in the current folder, which is not that of the file */
    assert_one_line(repeat("shots/shot.png", NULL), "room.obj", "outside its folder");
    unlink(in_folder("link.png"));
    assert_int_equal(symlink("shots/shot.png", in_folder("link.png")), 0);
    write_part(&parts[0], "../shots2/room.obj");
    assert_one_line(repeat("link.png", NULL), "link.png", "outside its folder");
}

static void a_user_may_name_and_allow_any(void **unused) {
    (void)unused;
    const char *const name = "../shots2/room.obj";
    write_files();
    write_part(&parts[0], name);
    assert_int_equal(repeat_with("shots/shot.png", "--allow-paths", NULL), 0);
    assert_int_equal(repeat_with("shots/shot.png", name, NULL), 0);
    assert_one_line(look_with("shots/shot.png", "--allow-paths", NULL), name, "display");
    assert_one_line(look_with("shots/shot.png", name, NULL), name, "display");
    write_part(&parts[2], name);
    assert_one_line(look_with("shots/shot.png", "--allow-paths", NULL), name, "display");
    assert_one_line(look_with("shots/shot.png", "--material", MATERIAL_TEXT("../shots2/room.obj")),
                    name, "display");
    assert_one_line(look_with("shots/shot.png", "--material", "test_materials=ggx:0.3"), name,
                    "outside its folder");
    assert_one_line(look_with("shots/shot.png", "builtin:ball", NULL), name, "outside its folder");
}

/* Built-in names and formulas are not files. */
static void what_is_no_file_is_not_looked_for(void **unused) {
    (void)unused;
    static const char *const materials[] = { "sgd:nickel", "lambert:0.5", "phong:3", "ggx:0.3:0.9",
                                             "sheen:0.5" };
    write_files();
    assert_int_equal(chdir("/"), 0);
    for (size_t i = 0; i < sizeof materials / sizeof *materials; i++) {
        write_part(&parts[2], materials[i]);
        strcpy(state.now.environment.name, "studio");
        write_shot("shots/shot.png", 8, 8);
        assert_one_line(look_with("shots/shot.png", NULL, NULL), materials[i], "display");
    }
}

/* --- names whose meaning changes -------------------------------------------------------------- */

/* Exchanges two names again and again, until it is killed. */
static pid_t exchange(const char *a, const char *b) {
    const pid_t child = fork();
    while (child == 0)
        if (renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) != 0)
            _exit(1);
    return child;
}

static void write_panorama(const char *name, float value) {
    image pixels;
    base_error error;
    assert_true(image_create(&pixels, 8, 4, &error));
    for (int i = 0; i < 3 * 8 * 4; i++)
        pixels.rgb[i] = value;
    assert_true(image_write(&pixels, in_folder(name), NULL, &error));
    image_free(&pixels);
}

/* Opens the part that a screenshot names, and finds whether what was opened lies outside. */
static bool open_part(const view_settings *s, int which, bool *outside) {
    base_error error;
    bool ok = false;
    if (which == 0) {
        scene read;
        if ((ok = scene_load(s->scene, &(scene_options) { .no_cache = true }, &read, &error))) {
            *outside = read.material_count > 1;
            scene_free(&read);
        }
    } else if (which == 1) {
        environment read;
        if ((ok = environment_open(
                 &(environment_options) { .name = s->environment.name, .strength = 1 }, &world,
                 &read, &error))) {
            *outside = read.light.rgb[0] > 1;
            environment_free(&read);
        }
    } else {
        void *data;
        size_t size;
        if ((ok = file_read(view_material_of(s, "test_material"), 4096, &data, &size, &error))) {
            *outside = size > 4;
            free(data);
        }
    }
    return ok;
}

/* A folder beside the screenshot and a link that leads out are exchanged all the while: whatever
 * the name meant when it was checked, what is read lies inside. */
static void no_swapped_link_leads_out(void **unused) {
    (void)unused;
    static const char *const names[] = { "swap/room.obj", "swap/sky.exr", "swap/dull.bsdf" };
    const int times = check_count(40, 600);
    char inside[64], link[64], shot[64];
    write_files();
    mkdir(in_folder("shots/swap"), 0700);
    folder_write_text("shots/swap/room.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    folder_write_text("shots2/room.obj",
                      "usemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl b\nf 3 2 1\n");
    write_panorama("shots/swap/sky.exr", 1);
    write_panorama("shots2/sky.exr", 2);
    folder_write_text("shots/swap/dull.bsdf", "dull");
    folder_write_text("shots2/dull.bsdf", "secret");
    assert_int_equal(symlink("../shots2", in_folder("shots/swapped")), 0);
    snprintf(inside, sizeof inside, "%s/shots/swap", folder);
    snprintf(link, sizeof link, "%s/shots/swapped", folder);
    snprintf(shot, sizeof shot, "%s/shots/shot.png", folder);
    for (int which = 0; which < 3; which++) {
        int opened = 0, outside = 0;
        write_part(&parts[which], names[which]);
        const pid_t child = exchange(inside, link);
        for (int i = 0; i < times; i++) {
            static view_settings read;
            base_error error;
            bool led_out = false;
            if (!view_read_shot(shot, &(view_shot_options) { .pixels_max = 64 }, &read, &error) ||
                !open_part(&read, which, &led_out))
                continue;
            opened++;
            outside += led_out;
        }
        kill(child, SIGKILL);
        waitpid(child, NULL, 0);
        printf("tried: %d openings of a %s that changes, %d inside\n", times, parts[which].name,
               opened);
        assert_int_equal(outside, 0);
        assert_true(opened > 0);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(large_ones_are_refused_unless_allowed),   TEST(the_viewer_refuses_the_same),
        TEST(tables_too_large_for_a_gpu_are_not_made), TEST(none_reads_standard_input),
        TEST(names_that_lead_out_are_refused),         TEST(names_that_stay_are_opened),
        TEST(the_folder_is_where_the_file_lies),       TEST(a_user_may_name_and_allow_any),
        TEST(what_is_no_file_is_not_looked_for),       TEST(no_swapped_link_leads_out)
    };
    return cmocka_run_group_tests(tests, make_refused_folder, folder_remove);
}
