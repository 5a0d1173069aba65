/* SPDX-License-Identifier: MIT */
/* file_writer.h - files that are written all or not at all. */
#ifndef LAMPION_BASE_FILE_WRITER_H
#define LAMPION_BASE_FILE_WRITER_H

#include "app/base/error.h"

#include <stddef.h>
#include <stdio.h>

/* A file that appears under its name only when complete: it is written beside that name, then
 * renamed. Temporaries that killed runs left in the folder are removed. */
typedef struct file_writer {
    FILE *stream;           /* write here */
    int descriptor, reason; /* of the stream; errno of its first failure */
    char path[4096], temporary[4096];
} file_writer;

/* Opens the stream. The writer must not move in memory until it is committed or aborted. */
bool file_write_begin(file_writer *writer, const char *path, base_error *error);
/* Flushes, closes and renames the file; on failure removes the temporary and reports. */
bool file_write_commit(file_writer *writer, base_error *error);
/* Removes the temporary; does nothing after a commit. */
void file_write_abort(file_writer *writer);
/* Removes the temporary and reports why the stream failed, or else that `what` went wrong. Returns
 * false. */
bool file_write_fail(file_writer *writer, const char *what, base_error *error);

/* Removes all temporaries; for handlers of signals that end the program. */
void file_remove_temporaries(void);

/* Writes a whole file in one call. */
bool file_write_whole(const char *path, const void *data, size_t size, base_error *error);

#endif
