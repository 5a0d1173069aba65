/* SPDX-License-Identifier: MIT */
/* command.h - the subcommands: app/command/NAME.c defines command_NAME. */
#ifndef LAMPION_COMMAND_COMMAND_H
#define LAMPION_COMMAND_COMMAND_H

#include "app/base/cli.h"

/* All commands in the order of the help, NULL-terminated. */
extern const cli_command *const command_table[];

/* One line about the purpose of the program. */
extern const char command_program_summary[];

/* command_find returns the command of a name, or NULL; command_unknown reports that there is none,
 * and suggests the nearest. */
const cli_command *command_find(const char *name);
int command_unknown(const char *name);

/* Prints a command's help in the form of `word`: "--help", or one for `lampion man` and `lampion
 * completion`. Returns the exit status. */
int command_print_help(const cli_command *command, const char *word);

#endif
