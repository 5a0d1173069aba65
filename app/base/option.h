/* SPDX-License-Identifier: MIT */
/* option.h - the parts of option parsing; only app/base/cli_*.c include it. */
#ifndef LAMPION_BASE_OPTION_H
#define LAMPION_BASE_OPTION_H

#include "app/base/cli.h"

/* Stores the value `text` in the option's target, or says why it cannot. */
bool option_store(const cli_option *option, const char *text, base_error *error);

#define OPTIONS_MAX      64
#define OPTION_TEXT_SIZE 1024

/* Collects all rows that a command takes into an array of OPTIONS_MAX: those of its table and those
 * that every command has. Returns their count. */
int option_rows(const cli_command *command, const cli_option *options, cli_option *rows);

/* Returns the row of --quiet, which every command takes. */
cli_option option_quiet(bool *quiet);

/* Writes what an option does, what it accepts and its default: targets still hold defaults. */
void option_describe(const cli_option *option, char *text, size_t size);

/* Print what `lampion COMMAND --help` shows, the command's manual page, and its completion for each
 * shell. */
void option_help(const cli_command *command, const cli_option *options);
void option_man(const cli_command *command, const cli_option *options);
void option_bash(const cli_command *command, const cli_option *options);
void option_zsh(const cli_command *command, const cli_option *options);
void option_fish(const cli_command *command, const cli_option *options);

/* Finds an option's limits: those of its row, or those of its kind. */
void option_limits(const cli_option *option, double *minimum, double *maximum);

/* Returns how many digits to print an option's limits with: at most seven for values rounded to
 * float. */
int option_digits(const cli_option *option);

#endif
