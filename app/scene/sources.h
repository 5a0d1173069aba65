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

typedef struct source_set {
    const char *subject; /* the scene's name, for messages */
    const char *folder;  /* its real path */
    bool sandboxed;      /* the parent opens the files */
    source *items;
    size_t count;
    char (*absent)[sizeof((blob_source *)0)->path]; /* names that were not there */
    size_t absent_count;
    size_t listed; /* names of folders' entries that were compared but for case */
} source_set;

/* Opens the file of a source's path: relative, without "..", and after following links still inside
 * the folder. Where no file has that name, one is found whose name differs in case alone. -1 on
 * failure. */
int sources_open(source_set *set, const char *path, cli_error *error);

/* Reads the file that `uri` names, its percent-escapes decoded, or gives it again. The set keeps
 * it. */
bool sources_read(source_set *set, const char *uri, const source **found, cli_error *error);

/* The same, but for a file that is not there: *found is then NULL. */
bool sources_read_if_there(source_set *set, const char *uri, const source **found,
                           cli_error *error);

/* Frees what was read. */
void sources_free(source_set *set);

#endif
