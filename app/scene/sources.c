/* SPDX-License-Identifier: MIT */
#include "app/scene/sources.h"

#include "app/sandbox/sandbox.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

/* Whether what ends here, behind a slash or at the start, is "." or nothing, and so says nothing.
 */
static bool ends_empty(const char *path, size_t used) {
    const size_t before = used - (used > 0 && path[used - 1] == '.');
    return before == 0 || path[before - 1] == '/';
}

/* Decodes percent-escapes, turns backslashes into slashes and leaves out what says nothing, so that
 * a file has few names; false if it does not fit. */
static bool decode_uri(const char *uri, char *path, size_t size) {
    size_t used = 0;
    bool inside = false; /* behind the first byte, which may be the root's slash */
    for (const char *c = uri; *c; c++, inside = true) {
        char byte = *c == '\\' ? '/' : *c;
        if (*c == '%' && hex_digit(c[1]) >= 0 && hex_digit(c[2]) >= 0) {
            byte = (char)(hex_digit(c[1]) * 16 + hex_digit(c[2]));
            c += 2;
        }
        if (byte == 0 || used + 1 >= size)
            return false;
        if (byte == '/' && inside && ends_empty(path, used))
            used -= used > 0 && path[used - 1] == '.';
        else
            path[used++] = byte;
    }
    path[used] = 0;
    return used > 0;
}

static bool has_parent_component(const char *path) {
    for (const char *c = path; *c;) {
        const size_t length = strcspn(c, "/");
        if (length == 2 && c[0] == '.' && c[1] == '.')
            return true;
        c += length;
        c += *c == '/';
    }
    return false;
}

static bool has_scheme(const char *path) {
    const size_t length = strspn(path, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ+.-");
    return length > 0 && path[length] == ':';
}

/* Many absent names in large folders would take minutes: names that differ in case alone are looked
 * for among so many in all. */
#define LISTED_MAX 4000000

/* Replaces each part of the name behind `folder` that is not there by one that differs in case
 * alone, if there is one: files that come from where case says nothing. */
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

static bool fail_absent(const source_set *set, const char *name, cli_error *error) {
    return cli_fail(error, set->subject, "refers to \"%.200s\", which does not exist", name);
}

/* `full` receives where the file of that name is looked for. */
static bool resolve(const source_set *set, const char *name, char full[PATH_MAX],
                    cli_error *error) {
    if (name[0] == '/' || has_parent_component(name) || has_scheme(name))
        return cli_fail(error, set->subject,
                        "refers to \"%.200s\", which is outside its folder (only files inside are "
                        "read)",
                        name);
    const int length = snprintf(full, PATH_MAX, "%s/%s", set->folder, name);
    return (length >= 0 && length < PATH_MAX) ||
           cli_fail(error, set->subject, "refers to a file by too long a name");
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

/* The same words whether or not there is something where the link leads: that is not told. */
static bool fail_link(const source_set *set, const char *name, cli_error *error) {
    return cli_fail(error, set->subject,
                    "refers to \"%.200s\", a link that leaves its folder or leads nowhere (only "
                    "files inside are read)",
                    name);
}

/* The file at `full`, links followed, as a descriptor that reads nothing: what is asked of it is
 * then true of what is opened by it, whatever the names come to mean. */
static int find_file(source_set *set, const char *name, char full[PATH_MAX], cli_error *error) {
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
        cli_fail(error, set->subject, "refers to \"%.200s\", which cannot be opened", name);
    return found;
}

static bool fail_file(const source_set *set, const char *name, const cli_error *reason,
                      cli_error *error) {
    const char *what = strstr(reason->text, ": ");
    return cli_fail(error, set->subject, "refers to \"%.200s\", which %s", name,
                    what ? what + 2 : "cannot be read");
}

/* Opens what has been found, if that lies inside the folder. */
static int open_found(const source_set *set, const char *name, int found, cli_error *error) {
    char link[40], real[PATH_MAX];
    cli_error reason;
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

int sources_open(source_set *set, const char *name, cli_error *error) {
    char full[PATH_MAX];
    if (!resolve(set, name, full, error))
        return -1;
    const int found = find_file(set, name, full, error);
    const int fd = found < 0 ? -1 : open_found(set, name, found, error);
    if (found >= 0)
        close(found);
    return fd;
}

/* The one that has been read of the same file, by whatever name; NULL if there is none. */
static const source *find_same(const source_set *set, int file) {
    for (size_t i = 0; file >= 0 && i < set->count; i++)
        if (set->items[i].file == file)
            return &set->items[i];
    return NULL;
}

static bool read_source(source_set *set, source *item, cli_error *error) {
    cli_error reason;
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

bool sources_read(source_set *set, const char *uri, const source **found, cli_error *error) {
    char name[sizeof((source *)0)->path];
    if (!decode_uri(uri, name, sizeof name))
        return cli_fail(error, set->subject, "refers to a file by a name that is none");
    for (size_t i = 0; i < set->count; i++)
        if (strcmp(set->items[i].path, name) == 0) {
            *found = &set->items[i];
            return true;
        }
    if (set->count == BLOB_SOURCES_MAX)
        return cli_fail(error, set->subject, "refers to more than %d files", BLOB_SOURCES_MAX);
    if (!set->items && !(set->items = calloc(BLOB_SOURCES_MAX, sizeof *set->items)))
        return cli_fail(error, set->subject, "does not fit into memory");
    source *item = &set->items[set->count];
    strcpy(item->path, name);
    if (!read_source(set, item, error))
        return false;
    set->count++;
    *found = item;
    return true;
}

static bool is_known_absent(const source_set *set, const char *name) {
    for (size_t i = 0; i < set->absent_count; i++)
        if (strcmp(set->absent[i], name) == 0)
            return true;
    return false;
}

/* What is asked for again is not looked for again; without memory it is. */
static void remember_absent(source_set *set, const char *name) {
    if (!set->absent)
        set->absent = calloc(BLOB_SOURCES_MAX, sizeof *set->absent);
    if (set->absent && set->absent_count < BLOB_SOURCES_MAX)
        strcpy(set->absent[set->absent_count++], name);
}

bool sources_read_if_there(source_set *set, const char *uri, const source **found,
                           cli_error *error) {
    char name[sizeof *set->absent];
    cli_error reason, absent;
    *found = NULL;
    if (!decode_uri(uri, name, sizeof name))
        name[0] = 0;
    if (is_known_absent(set, name) || sources_read(set, uri, found, &reason))
        return true;
    /* In the sandbox this line is all that is known of the parent's failure. */
    fail_absent(set, name, &absent);
    if (strcmp(reason.text, absent.text) == 0) {
        remember_absent(set, name);
        return true;
    }
    *error = reason;
    return false;
}

void sources_free(source_set *set) {
    for (size_t i = 0; i < set->count; i++)
        if (!set->items[i].shared)
            free(set->items[i].data);
    free(set->items);
    free(set->absent);
    set->absent = NULL;
    set->absent_count = 0;
    set->items = NULL;
    set->count = 0;
}
