/* SPDX-License-Identifier: MIT */
#include "app/scene/sources.h"

#include "app/base/file.h"
#include "app/base/sandbox.h"
#include "app/scene/escape.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

/* Decodes percent-escapes and turns backslashes into slashes; returns false if the path does not
 * fit. */
static bool decode_escapes(const char *uri, char *path, size_t size) {
    size_t used = 0;
    for (const char *c = uri; *c;) {
        const bool backslash = *c == '\\';
        const char next = escape_next(&c), byte = backslash ? '/' : next;
        if (byte == 0 || used + 1 >= size)
            return false;
        path[used++] = byte;
    }
    path[used] = 0;
    return used > 0;
}

static bool has_scheme(const char *path) {
    const size_t length = strspn(path, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ+.-");
    return length > 0 && path[length] == ':';
}

/* Whether a name leads out of the folder by itself: absolute, on a drive, or above. */
static bool leads_outside(const char *path) {
    int depth = 0;
    if (path[0] == '/' || has_scheme(path))
        return true;
    while (*path && depth >= 0) {
        const size_t length = strcspn(path, "/");
        const bool up = length == 2 && memcmp(path, "..", 2) == 0;
        const bool stay = length == 0 || (length == 1 && path[0] == '.');
        depth += up ? -1 : stay ? 0 : 1;
        path += length + (path[length] == '/');
    }
    return depth < 0;
}

static bool has_parent_component(const char *path) {
    for (const char *c = path; *c;) {
        const size_t length = strcspn(c, "/");
        if (length == 2 && memcmp(c, "..", 2) == 0)
            return true;
        c += length;
        c += *c == '/';
    }
    return false;
}

/* Removes "." and ".." from a path that stays inside (RFC 3986, 5.2.4), and doubled slashes, so
 * that a file has few names. */
static void remove_dots(char *path) {
    char *out = path;
    for (const char *at = path; *at;) {
        const size_t length = strcspn(at, "/");
        const size_t next = length + (at[length] == '/');
        if (length == 2 && memcmp(at, "..", 2) == 0) {
            out -= out > path;
            while (out > path && out[-1] != '/')
                out--;
        } else if (length > 0 && !(length == 1 && at[0] == '.')) {
            memmove(out, at, next);
            out += next;
        }
        at += next;
    }
    *out = 0;
}

/* Converts a name in a scene to the path of a source. */
static bool path_of(const char *uri, char *path, size_t size) {
    if (!decode_escapes(uri, path, size))
        return false;
    if (!leads_outside(path))
        remove_dots(path);
    return path[0] != 0;
}

/* How many directory entries are compared in all with names that may differ in case: many absent
 * names in large folders would take minutes. */
#define LISTED_MAX 4000000

/* Replaces each part of the path behind `folder` that does not exist by one that differs in case
 * alone, if there is one: some files come from systems that ignore case. */
static void match_case(source_set *set, char *full) {
    for (char *part = full + strlen(set->folder), *end; *part; part = end) {
        part += *part == '/';
        end = part + strcspn(part, "/");
        const char after = *end, before = part[-1];
        struct stat status;
        DIR *listing = NULL;
        *end = 0;
        if (lstat(full, &status) != 0 && set->listed < LISTED_MAX) {
            part[-1] = 0;
            listing = opendir(full);
            part[-1] = before;
        }
        for (const struct dirent *entry; listing && (entry = readdir(listing)); set->listed++)
            if (strcasecmp(entry->d_name, part) == 0) {
                memcpy(part, entry->d_name, strlen(part));
                break;
            }
        if (listing)
            closedir(listing);
        *end = after;
    }
}

static bool fail_absent(const source_set *set, const char *name, base_error *error) {
    return base_fail(error, set->subject, "refers to \"%.200s\", which does not exist", name);
}

static bool fail_outside(const source_set *set, const char *name, base_error *error) {
    return base_fail(
        error, set->subject,
        "refers to \"%.200s\", which is outside its folder (only files inside are read)", name);
}

/* Writes to `full` where the file of that name is looked for. */
static bool resolve(const source_set *set, const char *name, char full[PATH_MAX],
                    base_error *error) {
    /* names from sources_read have no dots; those from other readers may have them */
    if (leads_outside(name) || has_parent_component(name))
        return fail_outside(set, name, error);
    const int length = snprintf(full, PATH_MAX, "%s/%s", set->folder, name);
    return (length >= 0 && length < PATH_MAX) ||
           base_fail(error, set->subject, "refers to a file by too long a name");
}

static bool is_inside(const char *folder, const char *path) {
    const size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && (length == 1 || path[length] == '/');
}

/* Whether a part of the name behind `folder` is a link. */
static bool has_link(const source_set *set, char *full) {
    bool found = false;
    for (char *end = full + strlen(set->folder); *end && !found;) {
        struct stat status;
        end += 1 + strcspn(end + 1, "/");
        const char after = *end;
        *end = 0;
        found = lstat(full, &status) == 0 && S_ISLNK(status.st_mode);
        *end = after;
    }
    return found;
}

/* Fails with the same message whether or not the link leads to something, so as not to reveal
 * that. */
static bool fail_link(const source_set *set, const char *name, base_error *error) {
    return base_fail(error, set->subject,
                     "refers to \"%.200s\", a link that leaves its folder or leads nowhere (only "
                     "files inside are read)",
                     name);
}

/* Opens the file at `full`, links followed, as a descriptor without read access: what is checked
 * through it holds for what is opened through it, however the names may change. */
static int find_file(source_set *set, const char *name, char full[PATH_MAX], base_error *error) {
    int found = open(full, O_PATH | O_CLOEXEC), reason = errno;
    if (found < 0 && reason == ENOENT) {
        match_case(set, full);
        found = open(full, O_PATH | O_CLOEXEC);
        reason = errno;
    }
    if (found < 0 && has_link(set, full))
        fail_link(set, name, error);
    else if (found < 0 && reason == ENOENT)
        fail_absent(set, name, error);
    else if (found < 0)
        base_fail(error, set->subject, "refers to \"%.200s\", which cannot be opened", name);
    return found;
}

static bool fail_file(const source_set *set, const char *name, const base_error *reason,
                      base_error *error) {
    const char *what = strstr(reason->text, ": ");
    return base_fail(error, set->subject, "refers to \"%.200s\", which %s", name,
                     what ? what + 2 : "cannot be read");
}

/* Opens the found file for reading if it lies inside the folder. */
static int open_found(const source_set *set, const char *name, int found, base_error *error) {
    char link[40], real[PATH_MAX];
    base_error reason;
    snprintf(link, sizeof link, "/proc/self/fd/%d", found);
    const ssize_t length = readlink(link, real, sizeof real - 1);
    real[length > 0 ? length : 0] = 0;
    if (!is_inside(set->folder, real)) {
        fail_link(set, name, error);
        return -1;
    }
    const int fd = file_open_descriptor(link, &reason);
    if (fd < 0)
        fail_file(set, name, &reason, error);
    return fd;
}

int sources_open(source_set *set, const char *name, base_error *error) {
    char full[PATH_MAX];
    if (!resolve(set, name, full, error))
        return -1;
    const int found = find_file(set, name, full, error);
    const int fd = found < 0 ? -1 : open_found(set, name, found, error);
    if (found >= 0)
        close(found);
    return fd;
}

/* Returns the source that was already read from the same file under any name, or NULL. */
static const source *find_same(const source_set *set, int file) {
    for (size_t i = 0; file >= 0 && i < set->count; i++)
        if (set->items[i].file == file)
            return &set->items[i];
    return NULL;
}

static bool read_source(source_set *set, source *item, base_error *error) {
    base_error reason;
    item->file = -1;
    const int fd = set->sandboxed ? sandbox_open(item->path, &item->file, error)
                                  : sources_open(set, item->path, error);
    if (fd < 0)
        return false;
    const source *const same = find_same(set, item->file);
    bool ok = true;
    if (same) {
        item->data = same->data;
        item->size = same->size;
        item->shared = true;
    } else {
        ok = file_read_descriptor(fd, item->path, SOURCES_SIZE_LIMIT, &item->data, &item->size,
                                  &reason);
    }
    close(fd);
    return ok || fail_file(set, item->path, &reason, error);
}

static bool read_path(source_set *set, const char *path, const source **found, base_error *error) {
    for (size_t i = 0; i < set->count; i++)
        if (strcmp(set->items[i].path, path) == 0) {
            *found = &set->items[i];
            return true;
        }
    if (set->count == BLOB_SOURCES_MAX)
        return base_fail(error, set->subject, "refers to more than %d files", BLOB_SOURCES_MAX);
    if (!set->items && !(set->items = calloc(BLOB_SOURCES_MAX, sizeof *set->items)))
        return base_fail(error, set->subject, "does not fit into memory");
    source *item = &set->items[set->count];
    strcpy(item->path, path);
    if (!read_source(set, item, error))
        return false;
    set->count++;
    *found = item;
    return true;
}

bool sources_read(source_set *set, const char *uri, const source **found, base_error *error) {
    char path[sizeof((source *)0)->path];
    if (!path_of(uri, path, sizeof path))
        return base_fail(error, set->subject, "refers to a file by a name that is none");
    /* reported here, where the name is still as the file has it */
    return leads_outside(path) ? fail_outside(set, uri, error) : read_path(set, path, found, error);
}

/* --- files that a scene can do without -------------------------------------------------------- */

const char *const source_state_nouns[SOURCE_STATES] = {
    [SOURCE_MISSING] = "missing file",
    [SOURCE_OUTSIDE] = "file outside the folder",
    [SOURCE_UNREADABLE] = "unreadable file",
};

/* Remembers an absent file so that it is not looked for again; without memory it is. */
static void remember(source_set *set, const char *path, source_state state) {
    if (!set->absent) {
        set->absent = calloc(BLOB_SOURCES_MAX, sizeof *set->absent);
        set->absent_state = calloc(BLOB_SOURCES_MAX, sizeof *set->absent_state);
    }
    if (!set->absent || !set->absent_state || set->absent_count == BLOB_SOURCES_MAX)
        return;
    set->absent_state[set->absent_count] = state;
    strcpy(set->absent[set->absent_count++], path);
}

static source_state recall(const source_set *set, const char *path) {
    for (size_t i = 0; i < set->absent_count; i++)
        if (strcmp(set->absent[i], path) == 0)
            return set->absent_state[i];
    return SOURCE_READ;
}

bool sources_read_optional(source_set *set, const char *uri, const source **found,
                           source_state *state, base_error *error) {
    char path[sizeof *set->absent];
    base_error reason, known;
    *found = NULL;
    if (!path_of(uri, path, sizeof path)) {
        *state = SOURCE_UNREADABLE;
        return true;
    }
    *state = leads_outside(path) ? SOURCE_OUTSIDE : recall(set, path);
    if (*state != SOURCE_READ || read_path(set, path, found, &reason))
        return true;
    if (base_is_out_of_memory(&reason)) {
        *error = reason;
        return false;
    }
    /* in the sandbox this message is all that is known of the parent's failure */
    fail_absent(set, path, &known);
    *state = strcmp(reason.text, known.text) == 0 ? SOURCE_MISSING : SOURCE_UNREADABLE;
    remember(set, path, *state);
    return true;
}

void sources_free(source_set *set) {
    for (size_t i = 0; i < set->count; i++)
        if (!set->items[i].shared)
            free(set->items[i].data);
    free(set->items);
    free(set->absent);
    free(set->absent_state);
    set->absent = NULL;
    set->absent_state = NULL;
    set->absent_count = 0;
    set->items = NULL;
    set->count = 0;
}
