/* SPDX-License-Identifier: MIT */
/* printable.h - which characters a terminal shows, of texts that are not ours. */
#ifndef LAMPION_CLI_PRINTABLE_H
#define LAMPION_CLI_PRINTABLE_H

#include <stddef.h>
#include <stdint.h>

/* Bytes of the UTF-8 character at text, 0 if it is none, or one that a terminal obeys: a control
 * character (C0, DEL, C1), or one that turns the direction of writing. */
size_t cli_printable(const char *text);

/* Bytes of the UTF-8 character at text, whatever it is, and its number; 0 if it is none. */
size_t cli_character(const char *text, uint32_t *code);

/* Prints a name of a file to stdout, with a ? for each byte of what is not printable. */
void cli_print_name(const char *name);

#endif
