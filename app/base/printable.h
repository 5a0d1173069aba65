/* SPDX-License-Identifier: MIT */
/* printable.h - which characters of untrusted text are safe to show on a terminal. */
#ifndef LAMPION_BASE_PRINTABLE_H
#define LAMPION_BASE_PRINTABLE_H

#include <stddef.h>
#include <stdint.h>

/* Returns the length in bytes of the UTF-8 character at `text`, or 0 if there is no valid one or a
 * terminal would act on it: a control character (C0, DEL, C1), or one that changes the direction of
 * writing. */
size_t printable_length(const char *text);

/* Returns the length in bytes of the UTF-8 character at `text`, printable or not, or 0 if there is
 * no valid one; *code receives its code point. */
size_t printable_character(const char *text, uint32_t *code);

/* Prints a file name to stdout, with a ? in place of each byte that is not part of a printable
 * character. */
void printable_print(const char *name);

#endif
