/* SPDX-License-Identifier: MIT */
/* sandbox.h - runs a function in a child process that can harm nothing: bounded memory, time and
 * output, no new files, processes or connections. */
#ifndef LAMPION_SCENE_SANDBOX_H
#define LAMPION_SCENE_SANDBOX_H

#include "app/cli/cli.h"

/* Work of the child: writes its result to the descriptor `output`, or fails with *error. */
typedef bool (*sandbox_work)(void *context, int output, cli_error *error);

/* Runs work(context) in the sandbox. True: *output is a sealed memory file with what it wrote, to
 * be closed by the caller. A crash or an exceeded limit is an error like any other. */
bool sandbox_run(sandbox_work work, void *context, const char *subject, int *output,
                 cli_error *error);

/* To be called by the work as soon as it knows the bytes it has to read: sets the limits that suit
 * them. Until then those of an empty input hold. */
void sandbox_expect_input(uint64_t bytes);

#endif
