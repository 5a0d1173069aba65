/* SPDX-License-Identifier: MIT */
/* folder.h - a test's own folder for files, made before its first test and removed after its last.
 */
#ifndef LAMPION_FOLDER_H
#define LAMPION_FOLDER_H

#include "tests/oracle/check.h"

#include <stdlib.h>
#include <string.h>

static char folder[] = "/tmp/lampion-test-XXXXXX";

/* A name in the folder, until the next call. */
static inline const char *in_folder(const char *name) {
    static char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static inline void folder_write(const char *name, const void *data, size_t size) {
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static inline void folder_write_text(const char *name, const char *text) {
    folder_write(name, text, strlen(text));
}

static inline int folder_make(void **state) {
    (void)state;
    return mkdtemp(folder) ? 0 : 1;
}

static inline int folder_remove(void **state) {
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

#endif
