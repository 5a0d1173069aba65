/* SPDX-License-Identifier: MIT */
#include "app/scene/sources.h"

#include "app/sandbox/sandbox.h"

#include <dirent.h>
#include <errno.h>
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

/* Decodes percent-escapes and turns backslashes into slashes; false if it does not fit. */
static bool decode_uri(const char *uri, char *path, size_t size) {
    size_t used = 0;
    for (const char *c = uri; *c; c++) {
        char byte = *c == '\\' ? '/' : *c;
        if (*c == '%' && hex_digit(c[1]) >= 0 && hex_digit(c[2]) >= 0) {
            byte = (char)(hex_digit(c[1]) * 16 + hex_digit(c[2]));
            c += 2;
        }
        if (byte == 0 || used + 1 >= size)
            return false;
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

/* Replaces each part of the name behind `folder` that is not there by one that differs in case
 * alone, if there is one: files that come from where case says nothing. */
static void match_case(char *full, size_t folder) {
    for (char *part = full + folder, *end; *part; part = end) {
        part += *part == '/';
        end = part + strcspn(part, "/");
        const char after = *end, before = part[-1];
        struct stat status;
        DIR *listing = NULL;
        *end = 0;
        if (lstat(full, &status) != 0) {
            part[-1] = 0;
            listing = opendir(full);
            part[-1] = before;
        }
        for (const struct dirent *entry; listing && (entry = readdir(listing));)
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

/* `real` receives the full name of the file. */
static bool resolve(const source_set *set, const char *uri, char real[PATH_MAX], cli_error *error) {
    char name[sizeof((source *)0)->path], full[PATH_MAX];
    if (!decode_uri(uri, name, sizeof name))
        return cli_fail(error, set->subject, "refers to a file by a name that is none");
    if (name[0] == '/' || has_parent_component(name) || has_scheme(name))
        return cli_fail(error, set->subject,
                        "refers to \"%.200s\", which is outside its folder (only files inside are "
                        "read)",
                        name);
    const int length = snprintf(full, sizeof full, "%s/%s", set->folder, name);
    if (length < 0 || (size_t)length >= sizeof full)
        return cli_fail(error, set->subject, "refers to a file by too long a name");
    if (!realpath(full, real) && errno == ENOENT)
        match_case(full, strlen(set->folder));
    if (!realpath(full, real))
        return errno == ENOENT ? fail_absent(set, name, error)
                               : cli_fail(error, set->subject,
                                          "refers to \"%.200s\", which cannot be opened", name);
    const size_t folder_length = strlen(set->folder);
    const bool at_root = folder_length == 1;
    if (strncmp(real, set->folder, folder_length) != 0 || (!at_root && real[folder_length] != '/'))
        return cli_fail(error, set->subject,
                        "refers to \"%.200s\", a link that leaves its folder (only files inside "
                        "are read)",
                        name);
    return true;
}

static bool fail_file(const source_set *set, const char *uri, const cli_error *reason,
                      cli_error *error) {
    const char *what = strstr(reason->text, ": ");
    return cli_fail(error, set->subject, "refers to \"%.200s\", which %s", uri,
                    what ? what + 2 : "cannot be read");
}

int sources_open(const source_set *set, const char *uri, cli_error *error) {
    char path[PATH_MAX];
    cli_error reason;
    if (!resolve(set, uri, path, error))
        return -1;
    const int fd = file_open_descriptor(path, &reason);
    if (fd < 0)
        fail_file(set, uri, &reason, error);
    return fd;
}

static bool read_source(const source_set *set, const char *uri, source *item, cli_error *error) {
    cli_error reason;
    const int fd = set->sandboxed ? sandbox_open(uri, error) : sources_open(set, uri, error);
    if (fd < 0)
        return false;
    const bool ok =
        file_read_descriptor(fd, uri, SOURCES_SIZE_LIMIT, &item->data, &item->size, &reason);
    close(fd);
    return ok || fail_file(set, uri, &reason, error);
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
    if (set->count == SOURCES_MAX)
        return cli_fail(error, set->subject, "refers to more than %d files", SOURCES_MAX);
    if (!set->items && !(set->items = calloc(SOURCES_MAX, sizeof *set->items)))
        return cli_fail(error, set->subject, "does not fit into memory");
    source *item = &set->items[set->count];
    if (!read_source(set, uri, item, error))
        return false;
    strcpy(item->path, name);
    set->count++;
    *found = item;
    return true;
}

bool sources_read_if_there(source_set *set, const char *uri, const source **found,
                           cli_error *error) {
    char name[sizeof((source *)0)->path];
    cli_error reason, absent;
    *found = NULL;
    if (sources_read(set, uri, found, &reason))
        return true;
    /* In the sandbox this line is all that is known of the parent's failure. */
    fail_absent(set, decode_uri(uri, name, sizeof name) ? name : "", &absent);
    if (strcmp(reason.text, absent.text) == 0)
        return true;
    *error = reason;
    return false;
}

void sources_free(source_set *set) {
    for (size_t i = 0; i < set->count; i++)
        free(set->items[i].data);
    free(set->items);
    set->items = NULL;
    set->count = 0;
}
