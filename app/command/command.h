/* SPDX-License-Identifier: MIT */
/* command.h - the subcommands: app/command/NAME.c defines command_NAME. */
#ifndef LAMPION_COMMAND_H
#define LAMPION_COMMAND_H

#include "app/cli/cli.h"

/* All commands in the order of the help, NULL-terminated. */
extern const cli_command *const command_table[];

/* The names of lmp_window by its values, NULL-terminated: choices of --window. */
extern const char *const command_windows[];

/* The processor as it calls itself. */
void command_processor(char *name, size_t size);

#endif
