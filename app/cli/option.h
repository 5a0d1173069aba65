/* SPDX-License-Identifier: MIT */
/* option.h - the parts of option parsing; nothing outside app/cli includes it. */
#ifndef LAMPION_CLI_OPTION_H
#define LAMPION_CLI_OPTION_H

#include "app/cli/cli.h"

/* Stores the value `text` in the option's target, or says why it cannot. */
bool option_store(const cli_option *option, const char *text, cli_error *error);

/* Prints the help of a command to stdout; targets still hold their defaults. */
void option_help(const cli_command *command, const cli_option *options);

/* A table's limits: its own, or those of its kind. */
void option_limits(const cli_option *option, double *minimum, double *maximum);

#endif
