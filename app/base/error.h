/* SPDX-License-Identifier: MIT */
/* error.h - what a person is told: one line of error, notes, and a command's exit status. */
#ifndef LAMPION_BASE_ERROR_H
#define LAMPION_BASE_ERROR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Exit statuses of the program. */
enum { BASE_OK = 0, BASE_FAILURE = 1, BASE_USAGE = 2 };

/* One line for a person: "FILE: what is wrong (what to do)". Empty text means no error. */
typedef struct base_error {
    char text[1024];
} base_error;

/* Writes "subject: message" (with subject NULL the message alone), control characters replaced, and
 * returns false, so that a function can end in `return base_fail(error, path, "is empty");`. */
bool base_fail(base_error *error, const char *subject, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Whether memory ran out. Such a failure is never ignored, not even where what failed could be done
 * without. */
bool base_is_out_of_memory(const base_error *error);

/* Prints "lampion: text" to stderr and returns BASE_FAILURE. On a terminal the name of the program
 * is red, and in a note yellow, unless the environment has NO_COLOR. */
int base_report(const base_error *error);

/* Prints "lampion: subject: message" to stderr: a warning that stops nothing. */
void base_note(const char *subject, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
