/* SPDX-License-Identifier: MIT */
/* sandbox.h - runs a function in a child process that can do no harm: bounded memory, time and
 * output, no files but those the parent opens for it, no processes, no connections.
 * docs/security.md describes the limits. */
#ifndef LAMPION_BASE_SANDBOX_H
#define LAMPION_BASE_SANDBOX_H

#include "app/base/error.h"

#define SANDBOX_SECONDS 600 /* of wall-clock time, against a child that hangs */

typedef struct sandbox_job {
    const char *subject;  /* named in errors */
    uint64_t input_bytes; /* bytes that the work has to read at its start; limits grow with them */
    unsigned seconds;     /* of wall-clock time; 0: SANDBOX_SECONDS */
    void *context;

    /* Runs in the child: writes its result to the descriptor `output`, or fails with *error. */
    bool (*work)(void *context, int output, base_error *error);

    /* Runs in the parent when the child asks for a file: returns a descriptor to read it, or -1
     * with *error. NULL: there are no files. */
    int (*open)(void *context, const char *name, base_error *error);

    /* Runs in the parent: receives how much of the work is done, 0 … 1, as the child reports it.
     * May be NULL. */
    void (*progress)(void *context, double done);

    /* Runs in the parent, again and again: whether the job shall end at once. May be NULL. */
    bool (*cancelled)(void *context);
} sandbox_job;

/* Runs the job. On success *block is what the work wrote, `size` bytes of a mapping of its own, to
 * be released with munmap. A crash, an exceeded limit or an empty result is an error like any
 * other. */
bool sandbox_run(const sandbox_job *job, void **block, size_t *size, base_error *error);

/* Runs several jobs side by side; *blocks and *sizes have an item for each. On failure no block
 * remains. */
bool sandbox_run_all(const sandbox_job *jobs, size_t count, void **blocks, size_t *sizes,
                     base_error *error);

/* Writes all of the data to `output`; to be called by the work. */
bool sandbox_write(int output, const void *data, size_t size);

/* Reports how much of the work is done; the work may call it any number of times. Has no effect
 * outside a sandbox. */
void sandbox_progress(double done);

/* Asks the parent for the file of that name; to be called by the work. Returns a descriptor, or -1
 * with *error. The file's size is added to what the limits allow, once. A file has one *number, by
 * whatever name it is asked for. */
int sandbox_open(const char *name, int *number, base_error *error);

#endif
