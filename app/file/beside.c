/* SPDX-License-Identifier: MIT */
/* beside.c - whether a name leads out of a folder, found out without going there. */
#include "app/file/file.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

enum { LINKS_MAX = 40, REST_SIZE = 2 * PATH_MAX };

/* On the way: where it has come to, without links and a slash at the end, so the root is empty; the
 * parts that are left. */
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

/* Takes the next of the parts that are left into `part`; false if there is none, or no room. */
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

/* Puts where a link leads before what is left. */
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

/* A step into a part. Nothing is looked for in a folder that is neither above the one that matters
 * nor within it: to look may already mount what is there. */
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

/* The folder of a file, links followed; the current one, in which a relative name begins. */
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
