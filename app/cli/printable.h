/* SPDX-License-Identifier: MIT */
/* printable.h - which characters a terminal shows, of texts that are not ours. */
#ifndef LAMPION_CLI_PRINTABLE_H
#define LAMPION_CLI_PRINTABLE_H

#include <stddef.h>

/* Bytes of the UTF-8 character at text, 0 if it is none, or one that a terminal obeys: a control
 * character (C0, DEL, C1), or one that turns the direction of writing. */
size_t cli_printable(const char *text);

#endif
