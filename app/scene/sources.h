/* SPDX-License-Identifier: MIT */
/* sources.h - the files that a scene refers to: read once, and only from the scene's own folder. */
#ifndef LAMPION_SCENE_SOURCES_H
#define LAMPION_SCENE_SOURCES_H

#include "app/scene/blob.h"

#define SOURCES_SIZE_LIMIT ((size_t)8 << 30)

typedef struct source {
    char path[sizeof((blob_source *)0)->path]; /* relative to the folder, not a URI */
    void *data;
    size_t size;
    int file;    /* the sandbox's number for the file; -1 if unknown */
    bool shared; /* whether the data belong to an earlier source: the same file by another name */
} source;

/* Why a file that a scene can do without was not read. */
typedef enum source_state {
    SOURCE_READ,
    SOURCE_MISSING,    /* no file has that name */
    SOURCE_OUTSIDE,    /* the name leads out of the scene's folder */
    SOURCE_UNREADABLE, /* a link that leaves the folder, a folder, no permission … */
    SOURCE_STATES
} source_state;

/* The nouns that builder_unsupported takes for each state. */
extern const char *const source_state_nouns[SOURCE_STATES];

typedef struct source_set {
    const char *subject; /* the scene's name, for messages */
    const char *folder;  /* its real path */
    const char *variant; /* of the materials, as requested; NULL: the default */
    bool sandboxed;      /* whether the parent opens the files */
    source *items;
    size_t count;
    char (*absent)[sizeof((blob_source *)0)->path]; /* names that could not be read */
    source_state *absent_state;
    size_t absent_count;
    size_t listed; /* directory entries compared so far, ignoring case */
} source_set;

/* Opens the file at a source's path, which must lie inside the folder after links are followed. If
 * no file has that name, one whose name differs only in case is opened. Returns -1 on failure. */
int sources_open(source_set *set, const char *path, base_error *error);

/* Finds the file that `uri` names, reading it at the first request: percent-escapes are decoded,
 * "." and ".." are resolved as in RFC 3986. The set owns it. */
bool sources_read(source_set *set, const char *uri, const source **found, base_error *error);

/* Reads a file that the scene can do without: if it cannot be read, *found is NULL and *state says
 * why. Returns false only if memory ran out. */
bool sources_read_optional(source_set *set, const char *uri, const source **found,
                           source_state *state, base_error *error);

/* Frees all sources. */
void sources_free(source_set *set);

#endif
