/* SPDX-License-Identifier: MIT */
/* option.h - the parts of option parsing; nothing outside app/cli includes it. */
#ifndef LAMPION_CLI_OPTION_H
#define LAMPION_CLI_OPTION_H

#include "app/cli/cli.h"

/* Stores the value `text` in the option's target, or says why it cannot. */
bool option_store(const cli_option *option, const char *text, cli_error *error);

#define OPTIONS_MAX      64
#define OPTION_TEXT_SIZE 1024

/* All rows that a command takes, into an array of OPTIONS_MAX: those of its table, and what others
 * have too. Returns their count. */
int option_rows(const cli_command *command, const cli_option *options, cli_option *rows);

/* The row of --quiet, which every command takes. */
cli_option option_quiet(bool *quiet);

/* Writes what an option does, what it accepts and its default: targets still hold defaults. */
void option_describe(const cli_option *option, char *text, size_t size);

/* Print what `lampion COMMAND --help` shows, its manual page, and what each shell has to know to
 * complete it. */
void option_help(const cli_command *command, const cli_option *options);
void option_man(const cli_command *command, const cli_option *options);
void option_bash(const cli_command *command, const cli_option *options);
void option_zsh(const cli_command *command, const cli_option *options);
void option_fish(const cli_command *command, const cli_option *options);

/* Whether cli_be_quiet was called. */
bool cli_is_quiet(void);

/* Whether stderr is a terminal that can draw over what it shows. */
bool cli_is_terminal(void);

/* A table's limits: its own, or those of its kind. */
void option_limits(const cli_option *option, double *minimum, double *maximum);

/* How many digits tell them: what floats are rounded to has no more than seven. */
int option_digits(const cli_option *option);

#endif
