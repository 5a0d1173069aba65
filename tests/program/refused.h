/* SPDX-License-Identifier: MIT */
/* refused.h - the program run on files that it must refuse: it says so in one line, exits with 1,
 * and leaves nothing behind. */
#ifndef LAMPION_REFUSED_H
#define LAMPION_REFUSED_H

#include "tests/program/folder.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static inline int count_entries(const char *path) {
    DIR *listing = opendir(path);
    int count = 0;
    assert_non_null(listing);
    while (readdir(listing))
        count++;
    closedir(listing);
    return count;
}

/* Runs the program with its output in files; returns its exit status. */
static inline int run_program(const char *const arguments[]) {
    const pid_t child = fork();
    if (child == 0) {
        const int out = open(in_folder("stdout"), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        const int err = open(in_folder("stderr"), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(out, 1);
        dup2(err, 2);
        char *copies[16] = { 0 };
        for (int i = 0; arguments[i] && i < 15; i++)
            copies[i] = strdup(arguments[i]);
        execv(getenv("LAMPION_PROGRAM"), copies);
        _exit(127);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static inline size_t read_text(const char *name, char *text, size_t size) {
    FILE *file = fopen(in_folder(name), "rb");
    assert_non_null(file);
    const size_t got = fread(text, 1, size - 1, file);
    fclose(file);
    text[got] = 0;
    return got;
}

/* Asserts that the program printed one line that starts with "lampion" and contains `expected`. */
static inline void assert_one_line(int status, const char *what, const char *expected) {
    char text[4096];
    const size_t printed = read_text("stdout", text, sizeof text);
    const size_t size = read_text("stderr", text, sizeof text);
    if (status != 1 || printed != 0 || size == 0 || strchr(text, '\n') != text + size - 1 ||
        strncmp(text, "lampion: ", 9) != 0 || !strstr(text, expected))
        fail_msg("%s: status %d, \"%s\" instead of \"%s\"", what, status, text, expected);
}

/* Makes a folder with a cache of its own, and the files that every test needs. */
static inline int make_refused_folder(void **state) {
    (void)state;
    if (!mkdtemp(folder) || !getenv("LAMPION_PROGRAM"))
        return -1;
    mkdir(in_folder("cache"), 0700);
    setenv("XDG_CACHE_HOME", in_folder("cache"), 1);
    folder_write_text("stdout", "");
    folder_write_text("stderr", "");
    return 0;
}

#endif
