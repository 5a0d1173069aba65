/* SPDX-License-Identifier: MIT */
/* file_beside.c - decides whether a name leads out of a folder without going there, and checks
 * again once a file has been opened by that name. */
#include "app/base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

enum { LINKS_MAX = 40, REST_SIZE = 2 * PATH_MAX };

/* A walk along a path: the folder reached so far, with links resolved and without a trailing slash
 * (so the root is the empty string), and the components that remain. */
typedef struct walk {
    char folder[PATH_MAX], reached[PATH_MAX], rest[REST_SIZE];
    int links;
} walk;

static bool is_within(const char *folder, const char *path) {
    const size_t length = strlen(folder);
    return strncmp(path, folder, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

static void go_up(walk *w) {
    char *slash = strrchr(w->reached, '/');
    if (slash)
        *slash = '\0';
}

/* Moves the next remaining component into `part`; returns false if there is none, or no room for
 * it. */
static bool take_part(walk *w, char part[NAME_MAX + 1], bool *fits) {
    const size_t skipped = strspn(w->rest, "/"), length = strcspn(w->rest + skipped, "/");
    *fits = length <= NAME_MAX && strlen(w->reached) + 1 + length < sizeof w->reached;
    if (length == 0 || !*fits)
        return false;
    memcpy(part, w->rest + skipped, length);
    part[length] = '\0';
    memmove(w->rest, w->rest + skipped + length, strlen(w->rest + skipped + length) + 1);
    return true;
}

/* Puts the target of a link in front of the remaining components. */
static bool follow(walk *w, const char *target, size_t length) {
    const size_t left = strlen(w->rest);
    if (++w->links > LINKS_MAX || length + 1 + left >= sizeof w->rest)
        return false;
    memmove(w->rest + length + 1, w->rest, left + 1);
    memcpy(w->rest, target, length);
    w->rest[length] = '/';
    if (target[0] == '/')
        w->reached[0] = '\0';
    else
        go_up(w);
    return true;
}

/* Steps into a component. Only looks into folders that contain the confining folder or lie within
 * it: merely looking elsewhere may trigger an automount. */
static bool step(walk *w, const char *part) {
    char target[PATH_MAX];
    if (strcmp(part, ".") == 0)
        return true;
    if (strcmp(part, "..") == 0) {
        go_up(w);
        return true;
    }
    strcat(strcat(w->reached, "/"), part);
    const ssize_t length = readlink(w->reached, target, sizeof target);
    if (length >= (ssize_t)sizeof target)
        return false;
    if (length > 0)
        return follow(w, target, (size_t)length);
    return is_within(w->folder, w->reached) || is_within(w->reached, w->folder);
}

/* Finds the folder of a file, following links, and starts the walk in the current folder, to which
 * a relative name refers. */
static bool begin(walk *w, const char *path, const char *file) {
    if (strcmp(file, "-") == 0 || strlen(path) >= sizeof w->rest || !realpath(file, w->folder) ||
        !getcwd(w->reached, sizeof w->reached))
        return false;
    *strrchr(w->folder, '/') = '\0';
    if (path[0] == '/' || strcmp(w->reached, "/") == 0)
        w->reached[0] = '\0';
    strcpy(w->rest, path);
    w->links = 0;
    return true;
}

bool file_is_beside(const char *path, const char *file) {
    walk w;
    char part[NAME_MAX + 1];
    bool fits;
    if (!begin(&w, path, file))
        return false;
    while (take_part(&w, part, &fits))
        if (!step(&w, part))
            return false;
    return fits && is_within(w.folder, w.reached);
}

/* --- untrusted names -------------------------------------------------------------------------- */

/* Names that are confined to a folder. A program has only a few, which one thread records and none
 * frees; others may look meanwhile. */
typedef struct confined {
    char *path, *folder;
    struct confined *next;
} confined;
static _Atomic(confined *) all_confined;

static const char *folder_of(const char *path) {
    for (const confined *c = all_confined; c; c = c->next)
        if (strcmp(c->path, path) == 0)
            return c->folder;
    return NULL;
}

bool file_confine(const char *path, const char *file) {
    walk w;
    if (!file_is_beside(path, file) || !begin(&w, path, file))
        return false;
    const char *const known = folder_of(path);
    if (known && strcmp(known, w.folder) == 0)
        return true;
    confined *const c = malloc(sizeof *c);
    if (!c)
        return false;
    *c = (confined) { strdup(path), strdup(w.folder), all_confined };
    const bool ok = c->path && c->folder;
    if (ok) {
        all_confined = c;
    } else {
        free(c->path);
        free(c->folder);
        free(c);
    }
    return ok;
}

bool file_may_lead_to(const char *path, const char *real) {
    const char *const folder = folder_of(path);
    return !folder || is_within(folder, real);
}

int file_open_confined(const char *path, int flags) {
    char link[40], real[PATH_MAX];
    if (!folder_of(path))
        return open(path, flags);
    const int found = open(path, O_PATH | O_CLOEXEC);
    if (found < 0)
        return -1;
    snprintf(link, sizeof link, "/proc/self/fd/%d", found);
    const ssize_t length = readlink(link, real, sizeof real - 1);
    real[length > 0 ? length : 0] = '\0';
    errno = EXDEV;
    const int fd = file_may_lead_to(path, real) ? open(link, flags) : -1, reason = errno;
    close(found);
    errno = reason;
    return fd;
}
