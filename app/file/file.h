/* SPDX-License-Identifier: MIT */
/* file.h - whole files in and out: reading with limits, writing that is all or nothing, the cache.
 */
#ifndef LAMPION_FILE_H
#define LAMPION_FILE_H

#include "app/cli/cli.h"

#include <stdio.h>

/* Reads a whole regular file; "-" is standard input. Fails above `limit` bytes. The buffer has a
 * NUL past its end; free() it. */
bool file_read(const char *path, size_t limit, void **data, size_t *size, cli_error *error);

/* Whether the name of a file or a material has "-" in a file's place. Such a name is refused unless
 * it comes from the command line: no file may read the user's standard input. */
bool file_is_standard_input(const char *name);

/* Whether a name leads to where another file lies, or to a folder in there, links followed, also if
 * nothing has that name. Beside standard input lies nothing. It looks into no folder elsewhere. */
bool file_is_beside(const char *path, const char *file);

/* From now on what a name leads to must lie there, too, whenever it is opened: file_open and
 * file_read judge what they have opened, for links may have been swapped since the name was
 * checked. False if it is not so now. Before other threads start. */
bool file_confine(const char *path, const char *file);

/* Whether a name that may be confined may lead to what is `real`, a path without links. */
bool file_may_lead_to(const char *path, const char *real);

#define FILE_LEADS_OUT "leads out of the folder of what names it (see --allow-paths)"

/* open(2) of a name that may be confined; EXDEV where it leads out. */
int file_open_confined(const char *path, int flags);

/* Opens a regular file for reading; NULL, or -1, on failure. By whatever name, such as /dev/stdin,
 * it is not the one that is standard input: that is "-" alone. */
FILE *file_open(const char *path, cli_error *error);
int file_open_descriptor(const char *path, cli_error *error);

/* file_read of one that is open, from its start; `path` is named in the error. */
bool file_read_descriptor(int fd, const char *path, size_t limit, void **data, size_t *size,
                          cli_error *error);

/* Where a text stops being one JSON value with nothing after it; NULL if it is one. Stricter than
 * the parser, which then reads what it says and no less. */
const char *file_json_wrong(const char *text, size_t size);

/* What is usually the cause of that: a text for a person, static storage. */
const char *file_json_cause(const char *text, size_t size, const char *wrong);

/* One JSON value and nothing after it. The file is named in the error. Free with cJSON_Delete; NULL
 * on failure. */
struct cJSON *file_parse_json(const char *path, const char *text, size_t size, cli_error *error);
struct cJSON *file_read_json(const char *path, size_t limit, cli_error *error);

/* The text of a JSON value, in lines or in one, to be freed; deletes the value. NULL if memory ran
 * out for any part of it, also while it was made: whoever makes JSON prints it by this. */
char *file_json_text(struct cJSON *root, bool lines, const char *subject, cli_error *error);

/* Prints such a text in lines to stdout. What a terminal obeys, in the name of a file, is escaped;
 * bytes that are no UTF-8 become U+FFFD. */
bool file_json_print(struct cJSON *root, const char *subject, cli_error *error);

/* Its values, strictly: what has another type, count or range is not read. An item may be NULL. */
const struct cJSON *file_json_member(const struct cJSON *object, const char *name);
bool file_json_number(const struct cJSON *item, double minimum, double maximum, double *number);
bool file_json_numbers(const struct cJSON *item, int count, double minimum, double maximum,
                       double *numbers);

/* Adds one number or an array of more, in the shortest text that reads back as the floats. */
void file_json_add_floats(struct cJSON *object, const char *name, const float *numbers, int count);

/* The first key of an object that is none of the NULL-terminated ones; NULL if there is none. */
const char *file_json_unknown_key(const struct cJSON *object, const char *const *known);

/* A key that an object has twice; NULL if there is none. */
const char *file_json_repeated_key(const struct cJSON *object);

/* The array of { "name": [ … ] }, a file that holds nothing else; NULL on failure. */
const struct cJSON *file_json_list(const char *path, const struct cJSON *root, const char *name,
                                   cli_error *error);

/* A file that appears under its name only when complete: written beside it, then renamed. What
 * killed runs left in the folder is removed. */
typedef struct file_writer {
    FILE *stream;           /* write here */
    int descriptor, reason; /* of the stream; errno of its first failure */
    char path[4096], temporary[4096];
} file_writer;

/* The writer stays where it is until it is committed or aborted. */
bool file_write_begin(file_writer *writer, const char *path, cli_error *error);
/* Flushes, closes, renames; on failure removes the temporary and reports. */
bool file_write_commit(file_writer *writer, cli_error *error);
/* Removes the temporary; does nothing after a commit. */
void file_write_abort(file_writer *writer);
/* The same with an error: why the stream failed, or else `what` went wrong. Returns false. */
bool file_write_fail(file_writer *writer, const char *what, cli_error *error);

/* For handlers of signals that end the program. */
void file_remove_temporaries(void);

/* All of it at once. */
bool file_write_whole(const char *path, const void *data, size_t size, cli_error *error);

/* --- the cache: entries by name in $XDG_CACHE_HOME/lampion or ~/.cache/lampion
 * ----------------------- What is there may vanish or be damaged at any time, and may be anyone's:
 * an entry counts only if it is a regular file of this user with the name, version and checksum
 * that it says itself. Its size is held to a limit: LAMPION_CACHE_MIB from the environment, else
 * FILE_CACHE_MIB. */
#define FILE_CACHE_MIB 2048

/* The directory, created on demand; false without a home (then go on without a cache). */
bool file_cache_directory(char *path, size_t size);

/* The bytes of an entry, not copied, and mapped from the start of a page: NULL where there is none
 * to be trusted. It counts as used now. Give them back with file_cache_unmap. Entries are replaced
 * or removed, never changed, so the bytes stay. */
const void *file_cache_map(const char *name, size_t *size);
void file_cache_unmap(const void *data, size_t size);

/* Stores an entry, then removes those unused for longest until the limit holds; without effect
 * where that is impossible. */
void file_cache_store(const char *name, const void *data, size_t size);

/* The same of the `size` bytes that an object is written to. */
void file_cache_store_object(const char *name, size_t size,
                             void (*write)(const void *object, void *bytes), const void *object);

typedef struct file_cache_usage {
    size_t files;
    uint64_t bytes, limit;
} file_cache_usage;
file_cache_usage file_cache_measure(void);

/* Removes every entry of the cache; files that are none stay. */
void file_cache_clear(void);

/* 128-bit content hash for cache keys and checksums (XXH3, against damage, not against malice);
 * chain calls with the same state. */
typedef struct file_hash {
    uint64_t low, high;
} file_hash;
void file_hash_add(file_hash *hash, const void *data, size_t size);
void file_hash_text(const file_hash *hash, char text[33]);

#endif
