/* SPDX-License-Identifier: MIT */
/* sources.h - the files a scene refers to: read once, and only inside the scene's own folder. */
#ifndef LAMPION_SCENE_SOURCES_H
#define LAMPION_SCENE_SOURCES_H

#include "app/scene/blob.h"

#define SOURCES_SIZE_LIMIT ((size_t)8 << 30)

typedef struct source {
    char path[sizeof((blob_source *)0)->path]; /* relative to the folder, not a URI */
    void *data;
    size_t size;
    int file;    /* the sandbox's number of it; -1: not known */
    bool shared; /* the data are an earlier one's: the same file by another name */
} source;

/* Why a file that a scene could do without is not read. */
typedef enum source_state {
    SOURCE_READ,
    SOURCE_MISSING,    /* no file has that name */
    SOURCE_OUTSIDE,    /* its name leads out of the scene's folder */
    SOURCE_UNREADABLE, /* a link that leaves the folder, a folder, what nobody may read … */
    SOURCE_STATES
} source_state;

/* What is left out by each state, for builder_left_out. */
extern const char *const source_state_nouns[SOURCE_STATES];

typedef struct source_set {
    const char *subject; /* the scene's name, for messages */
    const char *folder;  /* its real path */
    const char *variant; /* of its materials, which is wanted of it; NULL: those by default */
    bool sandboxed;      /* the parent opens the files */
    source *items;
    size_t count;
    char (*absent)[sizeof((blob_source *)0)->path]; /* names that could not be read */
    source_state *absent_state;
    size_t absent_count;
    size_t listed; /* names of folders' entries that were compared but for case */
} source_set;

/* Opens the file of a source's path: after following links still inside the folder. Where no file
 * has that name, one is found whose name differs in case alone. -1 on failure. */
int sources_open(source_set *set, const char *path, cli_error *error);

/* Reads the file that `uri` names, or gives it again: percent-escapes are decoded, "." and ".." go
 * as RFC 3986 has it. The set keeps it. */
bool sources_read(source_set *set, const char *uri, const source **found, cli_error *error);

/* Reads a file that the scene can do without: *found is NULL where it is not read, and *state says
 * why. False without memory alone. */
bool sources_read_optional(source_set *set, const char *uri, const source **found,
                           source_state *state, cli_error *error);

/* Frees what was read. */
void sources_free(source_set *set);

#endif
