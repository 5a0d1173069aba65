/* SPDX-License-Identifier: MIT */
/* The files that a scene names: inside its folder whatever happens meanwhile, by the name that was
 * meant, and each read and counted once. */
#include "app/scene/sources.h"

#include "app/base/sandbox.h"
#include "app/scene/scene.h"
#include "tests/program/folder.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZED 1 /* where the address space is not limited */
#else
#define SANITIZED 0
#endif

static char inner[64]; /* the scene's folder, inside the test's */

static const char *in_scene(const char *name) {
    static char path[64];
    snprintf(path, sizeof path, "inner/%s", name);
    return path;
}

/* --- where they lie --------------------------------------------------------------------------- */

/* Exchanges two names again and again, until it is killed. */
static pid_t exchange(const char *a, const char *b) {
    const pid_t child = fork();
    while (child == 0)
        if (renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) != 0)
            _exit(1);
    return child;
}

static void no_link_leads_outside_while_names_change(void **state) {
    (void)state;
    const int times = check_count(30000, 300000);
    source_set set = { .subject = "scene", .folder = inner };
    char file[128], link[128];
    int opened = 0;
    folder_write_text("secret", "secret");
    folder_write_text(in_scene("page"), "a page");
    assert_int_equal(symlink("../secret", in_folder(in_scene("link"))), 0);
    snprintf(file, sizeof file, "%s/page", inner);
    snprintf(link, sizeof link, "%s/link", inner);
    const pid_t child = exchange(file, link);
    for (int i = 0; i < times; i++) {
        base_error error;
        char text[7] = "";
        const int fd = sources_open(&set, "page", &error);
        if (fd < 0)
            continue;
        opened++;
        const bool honest = read(fd, text, 6) == 6 && strcmp(text, "a page") == 0;
        close(fd);
        if (!honest) {
            kill(child, SIGKILL);
            fail_msg("\"%s\" was read from outside the folder after %d openings", text, i);
        }
    }
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_true(opened > 0);
    printf("tried: %d openings of a name that changes\n", times);
}

static void a_link_tells_nothing_of_what_lies_outside(void **state) {
    (void)state;
    static const char *const targets[] = {
        "../kept", "../gone", "../kept/below", "../gone/below", "/", "/gone", "link",
    };
    static const char *const names[] = { "link", "LINK", "link/below" };
    source_set set = { .subject = "scene", .folder = inner };
    base_error error;
    folder_write_text("kept", "kept");
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        char expected[128];
        snprintf(expected, sizeof expected, "scene: refers to \"%s\", a link that leaves its",
                 names[n]);
        for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
            unlink(in_folder(in_scene("link")));
            assert_int_equal(symlink(targets[i], in_folder(in_scene("link"))), 0);
            assert_int_equal(sources_open(&set, names[n], &error), -1);
            if (strncmp(error.text, expected, strlen(expected)) != 0)
                fail_msg("of %s through %s it says: %s", targets[i], names[n], error.text);
        }
    }
    unlink(in_folder(in_scene("link")));
    assert_int_equal(sources_open(&set, "gone", &error), -1);
    assert_string_equal(error.text, "scene: refers to \"gone\", which does not exist");
}

/* --- by what names ---------------------------------------------------------------------------- */

static void a_name_is_decoded_once(void **state) {
    (void)state;
    source_set set = { .subject = "scene", .folder = inner };
    const source *found;
    base_error error;
    folder_write_text(in_scene("a b"), "with a space");
    folder_write_text(in_scene("a%20b"), "with an escape");
    assert_true(sources_read(&set, "a%20b", &found, &error));
    assert_string_equal(found->data, "with a space");
    assert_true(sources_read(&set, "a%2520b", &found, &error));
    assert_string_equal(found->data, "with an escape");
    const int fd = sources_open(&set, found->path, &error);
    char text[32] = "";
    assert_true(fd >= 0 && read(fd, text, sizeof text - 1) > 0);
    assert_string_equal(text, "with an escape");
    close(fd);
    sources_free(&set);
}

static void a_cached_scene_knows_its_files_by_the_same_names(void **state) {
    (void)state;
    static const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    char path[128];
    base_error error;
    folder_write(in_scene("my%20corners.bin"), corners, sizeof corners);
    folder_write_text(
        in_scene("scene.gltf"),
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
        "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
        "\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],\"buffers\":[{"
        "\"byteLength\":36,\"uri\":\"my%2520corners.bin\"}]}");
    snprintf(path, sizeof path, "%s/scene.gltf", inner);
    for (int i = 0; i < 2; i++) {
        scene world;
        if (!scene_load(path, &(scene_options) { 0 }, &world, &error))
            fail_msg("%s", error.text);
        assert_int_equal(world.cached, i);
        scene_free(&world);
    }
}

/* --- how often -------------------------------------------------------------------------------- */

enum { LARGE = 64 << 20 };

static int open_in_scene(void *context, const char *name, base_error *error) {
    return sources_open(context, name, error);
}

/* Reads one file by many names; then asking for more memory than the one file allows must be
 * refused. */
static bool read_by_many_names(void *context, int output, base_error *error) {
    static const char *const names[] = {
        "large", "./large", ".//./large", "LARGE", "link", "lArGe"
    };
    source_set set = *(source_set *)context;
    const source *first = NULL, *found;
    set.sandboxed = true;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!sources_read(&set, names[i], &found, error))
            return false;
        first = first ? first : found;
        if (found->data != first->data || found->size != LARGE)
            return base_fail(error, names[i], "is read again");
    }
    void *const memory =
        mmap(NULL, (size_t)8 << 30, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory != MAP_FAILED && !SANITIZED)
        return base_fail(error, NULL, "its limits grew with each name");
    return write(output, "once", 4) == 4;
}

static void a_file_by_many_names_is_read_and_counted_once(void **state) {
    (void)state;
    source_set set = { .subject = "scene", .folder = inner };
    void *block;
    size_t size;
    base_error error;
    folder_write_text(in_scene("large"), "");
    assert_int_equal(truncate(in_folder(in_scene("large")), LARGE), 0);
    assert_int_equal(symlink("large", in_folder(in_scene("link"))), 0);
    const sandbox_job job = {
        .subject = "scene", .context = &set, .work = read_by_many_names, .open = open_in_scene
    };
    if (!sandbox_run(&job, &block, &size, &error))
        fail_msg("%s", error.text);
    munmap(block, size);
}

/* There are more names than files may be opened: an absent file is looked up once. */
static void an_absent_file_may_be_named_by_many_materials(void **state) {
    (void)state;
    enum { MATERIALS = 4200, LINE = 64 };
    static char materials[MATERIALS * LINE];
    char path[128];
    size_t used = 0;
    base_error error;
    scene world;
    for (int i = 0; i < MATERIALS; i++)
        used += (size_t)snprintf(materials + used, LINE, "newmtl m%d\nmap_Kd gone.png\n", i);
    folder_write_text(in_scene("m.mtl"), materials);
    folder_write_text(in_scene("m.obj"),
                      "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m0\nf 1 2 3\n");
    snprintf(path, sizeof path, "%s/m.obj", inner);
    if (!scene_load(path, &(scene_options) { 0 }, &world, &error))
        fail_msg("%s", error.text);
    assert_int_equal(world.material_count, MATERIALS + 1);
    scene_free(&world);
}

/* Each absent name is looked up among all names of a folder, but not for ever. */
static void absent_names_are_looked_for_in_bounded_time(void **state) {
    (void)state;
    source_set set = { .subject = "scene", .folder = inner, .listed = (size_t)1 << 40 };
    base_error error;
    folder_write_text(in_scene("Page"), "a page");
    assert_int_equal(sources_open(&set, "page", &error), -1);
    set.listed = 0;
    const int fd = sources_open(&set, "page", &error);
    assert_true(fd >= 0 && set.listed > 0);
    close(fd);
}

static int make_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder) || setenv("XDG_CACHE_HOME", in_folder("cache"), 1) != 0)
        return 1;
    snprintf(inner, sizeof inner, "%s/inner", folder);
    return 0;
}

static int empty(void **state) {
    (void)state;
    char command[200];
    snprintf(command, sizeof command, "rm -rf '%s' && mkdir '%s'", inner, inner);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(no_link_leads_outside_while_names_change, empty),
        cmocka_unit_test_setup(a_link_tells_nothing_of_what_lies_outside, empty),
        cmocka_unit_test_setup(a_name_is_decoded_once, empty),
        cmocka_unit_test_setup(a_cached_scene_knows_its_files_by_the_same_names, empty),
        cmocka_unit_test_setup(a_file_by_many_names_is_read_and_counted_once, empty),
        cmocka_unit_test_setup(an_absent_file_may_be_named_by_many_materials, empty),
        cmocka_unit_test_setup(absent_names_are_looked_for_in_bounded_time, empty),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
