/* SPDX-License-Identifier: MIT */
/* The cache returns an entry only if it is what was stored, under its name, by this user; and
 * whatever is there, or cannot be, nothing waits and nothing fails. */
#include "app/base/error.h"
#include "app/base/file.h"
#include "app/base/file_cache.h"
#include "app/base/file_hash.h"
#include "app/base/file_writer.h"
#include "tests/program/folder.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { SIZE = 5000 };

static unsigned char first[SIZE], second[SIZE];

static const char *entry(const char *name) {
    static char path[600];
    char directory[512];
    assert_true(file_cache_directory(directory, sizeof directory));
    snprintf(path, sizeof path, "%s/%s", directory, name);
    return path;
}

static bool holds(const char *name, const unsigned char *expected) {
    size_t size = 0;
    const void *const data = file_cache_map(name, &size);
    const bool same = data && size == SIZE && memcmp(data, expected, SIZE) == 0;
    if (data && !same)
        fail_msg("%s: bytes that nobody stored", name);
    file_cache_unmap(data, size);
    return same;
}

static void what_is_stored_comes_back(void **state) {
    (void)state;
    assert_false(holds("a", first));
    file_cache_store("a", first, SIZE);
    assert_true(holds("a", first));
    file_cache_store("a", second, SIZE);
    assert_true(holds("a", second));
}

static void an_entry_under_another_name_is_none(void **state) {
    (void)state;
    char from[600];
    file_cache_store("a", first, SIZE);
    snprintf(from, sizeof from, "%s", entry("a"));
    assert_int_equal(rename(from, entry("b")), 0);
    assert_false(holds("a", first));
    assert_false(holds("b", first));
}

static unsigned char *read_entry(const char *name, size_t *size) {
    void *bytes;
    base_error error;
    assert_true(file_read(entry(name), 1 << 20, &bytes, size, &error));
    return bytes;
}

static void write_entry(const char *name, const unsigned char *bytes, size_t size) {
    FILE *file = fopen(entry(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static void a_damaged_entry_is_none(void **state) {
    (void)state;
    const size_t step = (size_t)check_count(23, 1);
    size_t size, tried = 0;
    file_cache_store("a", first, SIZE);
    unsigned char *bytes = read_entry("a", &size);
    for (size_t length = 0; length < size; length += step, tried++) {
        write_entry("a", bytes, length);
        assert_false(holds("a", first));
    }
    for (size_t bit = 0; bit < 8 * size; bit += 8 * step + 1, tried++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        write_entry("a", bytes, size);
        assert_false(holds("a", first));
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
    }
    write_entry("a", bytes, size);
    assert_true(holds("a", first));
    free(bytes);
    printf("tried: %zu damaged entries of the cache\n", tried);
}

/* The checksum fits the changed contents, so that only the version is wrong. */
static void an_entry_of_another_version_is_none(void **state) {
    (void)state;
    enum { VERSION = 8, ABOVE = 88 }; /* the version's offset, and bytes before the checksum */
    for (int added = 0; added < 2; added++) {
        size_t size;
        file_hash checksum = { 0 };
        file_cache_store("a", first, SIZE);
        unsigned char *bytes = read_entry("a", &size), *const end = bytes + SIZE;
        assert_int_equal(size, SIZE + ABOVE + sizeof checksum);
        end[VERSION] = (unsigned char)(end[VERSION] + added);
        file_hash_add(&checksum, bytes, SIZE);
        file_hash_add(&checksum, end, ABOVE);
        memcpy(end + ABOVE, &checksum, sizeof checksum);
        write_entry("a", bytes, size);
        assert_int_equal(holds("a", first), added == 0);
        free(bytes);
    }
}

static void what_is_no_file_of_ones_own_is_none(void **state) {
    (void)state;
    char target[600];
    file_cache_store("a", first, SIZE);
    snprintf(target, sizeof target, "%s", entry("a"));
    assert_int_equal(symlink(target, entry("link")), 0);
    assert_false(holds("link", first));
    assert_int_equal(mkfifo(entry("fifo"), 0600), 0);
    assert_false(holds("fifo", first)); /* nor does the cache wait for a writer */
    assert_int_equal(mkdir(entry("folder"), 0700), 0);
    assert_false(holds("folder", first));
    if (geteuid() == 0) {
        assert_int_equal(chown(entry("a"), 65534, 65534), 0);
        assert_false(holds("a", first));
    } else {
        printf("skipped: another user's file needs the right to make one\n");
    }
}

static bool exists(const char *name) {
    return access(entry(name), F_OK) == 0;
}

/* Files with names like entries, one of them with another entry's bytes: nobody stored them here,
 * so neither the limit nor the user's request to clear the cache concerns them. */
static void only_entries_are_counted_and_removed(void **state) {
    (void)state;
    static const char *const others[] = { "notes.txt", "scene-0123456789abcdef0123456789abcdef",
                                          "0123456789abcdef0123456789abcdef.lmpt", "copied" };
    enum { OTHERS = sizeof others / sizeof *others };
    size_t size;
    file_cache_store("a", first, SIZE);
    unsigned char *bytes = read_entry("a", &size);
    for (int i = 0; i < OTHERS - 1; i++)
        write_entry(others[i], second, SIZE);
    write_entry(others[OTHERS - 1], bytes, size);
    free(bytes);
    assert_int_equal(file_cache_measure().files, 1);
    assert_int_equal(file_cache_measure().bytes, size);
    assert_int_equal(setenv("LAMPION_CACHE_MIB", "0", 1), 0);
    file_cache_store("b", first, SIZE);
    unsetenv("LAMPION_CACHE_MIB");
    assert_false(exists("a") || exists("b"));
    file_cache_store("a", first, SIZE);
    file_cache_clear();
    assert_false(exists("a"));
    for (int i = 0; i < OTHERS; i++)
        if (!exists(others[i]))
            fail_msg("%s is no entry, and gone", others[i]);
}

static void a_linked_folder_is_no_cache(void **state) {
    (void)state;
    char path[600];
    file_cache_store("a", first, SIZE);
    snprintf(path, sizeof path, "%s", entry(""));
    path[strlen(path) - 1] = 0;
    assert_int_equal(rename(path, in_folder("elsewhere")), 0);
    assert_int_equal(symlink(in_folder("elsewhere"), path), 0);
    assert_false(holds("a", first));
    assert_int_equal(file_cache_measure().files, 0);
    file_cache_store("b", first, SIZE);
    file_cache_clear();
    assert_int_equal(access(in_folder("elsewhere/a"), F_OK), 0);
    assert_int_not_equal(access(in_folder("elsewhere/b"), F_OK), 0);
}

static void what_cannot_be_stored_is_no_error(void **state) {
    (void)state;
    struct rlimit old, small;
    getrlimit(RLIMIT_FSIZE, &old);
    small = old;
    small.rlim_cur = SIZE / 2;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &small);
    file_cache_store("large", first, SIZE);
    setrlimit(RLIMIT_FSIZE, &old);
    assert_false(holds("large", first));
    setenv("XDG_CACHE_HOME", "/proc", 1);
    file_cache_store("nowhere", first, SIZE);
    assert_false(holds("nowhere", first));
    setenv("XDG_CACHE_HOME", folder, 1);
    file_cache_store("a-name-of-more-than-the-63-characters-that-the-end-of-an-entry-holds", first,
                     SIZE);
    file_cache_store("again", first, SIZE);
    assert_true(holds("again", first));
}

static pid_t store_often(const unsigned char *bytes, int times) {
    const pid_t child = fork();
    for (int i = 0; child == 0 && i < times; i++)
        file_cache_store("shared", bytes, SIZE);
    if (child == 0)
        _exit(0);
    return child;
}

static void two_writers_leave_one_s_bytes(void **state) {
    (void)state;
    const int times = check_count(200, 20000);
    file_cache_store("shared", first, SIZE);
    const pid_t writers[] = { store_often(first, times), store_often(second, times) };
    for (int i = 0; i < times; i++) {
        size_t size;
        const void *const data = file_cache_map("shared", &size);
        assert_non_null(data);
        assert_int_equal(size, SIZE);
        assert_true(memcmp(data, first, SIZE) == 0 || memcmp(data, second, SIZE) == 0);
        file_cache_unmap(data, size);
    }
    for (int i = 0; i < 2; i++)
        waitpid(writers[i], NULL, 0);
}

/* --- sweeping --------------------------------------------------------------------------------- */

static bool renamed_locked;

/* Replaces the system's function, for the program. */
int rename(const char *from, const char *to) {
    const int fd = open(from, O_RDONLY | O_CLOEXEC);
    renamed_locked = fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (fd >= 0)
        close(fd);
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

/* Another machine, or container, learns only from the lock that the writer still exists. */
static void what_is_not_yet_renamed_is_locked(void **state) {
    (void)state;
    base_error error;
    assert_true(file_write_whole(in_folder("whole"), first, SIZE, &error));
    assert_true(renamed_locked);
    const int fd = open(in_folder("whole"), O_RDONLY | O_CLOEXEC);
    assert_true(fd >= 0);
    assert_int_equal(flock(fd, LOCK_EX | LOCK_NB), 0);
    close(fd);
}

static int make_folder(void **state) {
    (void)state;
    for (int i = 0; i < SIZE; i++) {
        first[i] = (unsigned char)(check_random() * 256);
        second[i] = (unsigned char)(check_random() * 256);
    }
    return mkdtemp(folder) && setenv("XDG_CACHE_HOME", folder, 1) == 0 ? 0 : 1;
}

static int empty(void **state) {
    (void)state;
    char command[512];
    snprintf(command, sizeof command, "rm -rf '%s/lampion' '%s/elsewhere'", folder, folder);
    return system(command);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(what_is_stored_comes_back, empty),
        cmocka_unit_test_setup(an_entry_under_another_name_is_none, empty),
        cmocka_unit_test_setup(a_damaged_entry_is_none, empty),
        cmocka_unit_test_setup(an_entry_of_another_version_is_none, empty),
        cmocka_unit_test_setup(what_is_no_file_of_ones_own_is_none, empty),
        cmocka_unit_test_setup(only_entries_are_counted_and_removed, empty),
        cmocka_unit_test_setup(a_linked_folder_is_no_cache, empty),
        cmocka_unit_test_setup(what_cannot_be_stored_is_no_error, empty),
        cmocka_unit_test_setup(what_is_not_yet_renamed_is_locked, empty),
        cmocka_unit_test_setup(two_writers_leave_one_s_bytes, empty),
    };
    return cmocka_run_group_tests(tests, make_folder, folder_remove);
}
