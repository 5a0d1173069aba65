/* SPDX-License-Identifier: MIT */
/* file.h - whole files, read within limits. */
#ifndef LAMPION_BASE_FILE_H
#define LAMPION_BASE_FILE_H

#include "app/base/error.h"

#include <stddef.h>
#include <stdio.h>

/* Reads a whole regular file; "-" is standard input. Fails above `limit` bytes. A NUL follows the
 * buffer's last byte; release the buffer with free. */
bool file_read(const char *path, size_t limit, void **data, size_t *size, base_error *error);

/* Returns the last part of a path, the name in its folder. */
const char *file_base_name(const char *path);

/* Whether a name found in a file or a material is "-". Such a name is refused unless it comes from
 * the command line: no file may read the user's standard input. */
bool file_is_standard_input(const char *name);

/* Whether a name leads, links followed, into the folder of another file or below it, also if no
 * file has that name. Nothing lies beside standard input. No folder elsewhere is looked into. */
bool file_is_beside(const char *path, const char *file);

/* Confines a name to the folder of `file` from now on: file_open and file_read check what they have
 * opened, because links may have been swapped since the name was checked. Returns false if the name
 * already leads elsewhere. Call it before other threads start. */
bool file_confine(const char *path, const char *file);

/* Whether a name, confined or not, may lead to the file at `real`, a path without links. */
bool file_may_lead_to(const char *path, const char *real);

#define FILE_LEADS_OUT "leads out of the folder of what names it (see --allow-paths)"

/* Does open(2) of a name that may be confined; fails with EXDEV where the name leads out. */
int file_open_confined(const char *path, int flags);

/* Opens a regular file for reading; returns NULL, or -1, on failure. Fails for a name such as
 * /dev/stdin that leads to standard input, which only "-" names. */
FILE *file_open(const char *path, base_error *error);
int file_open_descriptor(const char *path, base_error *error);

/* Reads a whole open file from its start, as file_read does; `path` is named in the error. */
bool file_read_descriptor(int fd, const char *path, size_t limit, void **data, size_t *size,
                          base_error *error);

#endif
