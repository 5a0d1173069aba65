/* SPDX-License-Identifier: MIT */
/* sandbox.h - runs a function in a child process that can harm nothing: bounded memory, time and
 * output, no files but those the parent opens for it, no processes, no connections. What it is held
 * to is told in docs/security.md. */
#ifndef LAMPION_SANDBOX_H
#define LAMPION_SANDBOX_H

#include "app/cli/cli.h"

#define SANDBOX_SECONDS 600 /* of the clock, against a child that waits for nothing */

typedef struct sandbox_job {
    const char *subject;  /* named in errors */
    uint64_t input_bytes; /* what the work has to read at its start: limits grow with it */
    unsigned seconds;     /* of the clock; 0: SANDBOX_SECONDS */
    void *context;

    /* In the child: writes its result to the descriptor `output`, or fails with *error. */
    bool (*work)(void *context, int output, cli_error *error);

    /* In the parent, when the child asks for a file: a descriptor to read it, or -1 with *error.
     * NULL: there are no files. */
    int (*open)(void *context, const char *name, cli_error *error);

    /* In the parent: how much of the work is done, 0 … 1, as the child says. NULL: nobody asks. */
    void (*progress)(void *context, double done);
} sandbox_job;

/* Runs the job. True: *block is what the work wrote, `size` bytes of a mapping of its own, for
 * munmap. A crash, an exceeded limit or an empty result is an error like any other. */
bool sandbox_run(const sandbox_job *job, void **block, size_t *size, cli_error *error);

/* Runs several jobs side by side; *blocks and *sizes have an item for each. On failure, none is
 * there. */
bool sandbox_run_all(const sandbox_job *jobs, size_t count, void **blocks, size_t *sizes,
                     cli_error *error);

/* For the work: writes all of it to `output`. */
bool sandbox_write(int output, const void *data, size_t size);

/* For the work, which may call it as often as it likes: how much of it is done. Outside a sandbox
 * it has no effect. */
void sandbox_progress(double done);

/* For the work: the file of that name from the parent, which adds its size to what the limits
 * allow, once; -1 with *error. A file has the same *number by every name. */
int sandbox_open(const char *name, int *number, cli_error *error);

#endif
