/* SPDX-License-Identifier: MIT */
/* choice.h - names that a person chooses from, and the error for a word that is none of them. */
#ifndef LAMPION_BASE_CHOICE_H
#define LAMPION_BASE_CHOICE_H

#include "app/base/error.h"

#include <stddef.h>

/* Fails with "subject: "word" is none of …" and suggests the name that may be meant; names is
 * NULL-terminated. */
bool choice_fail(base_error *error, const char *subject, const char *word,
                 const char *const *names);

/* Fails with "subject: no such kind: …" and suggests the nearest name. The names are members of an
 * array of structs, given by the first name, the bytes from one name to the next, and their
 * count. */
bool choice_fail_member(base_error *error, const char *subject, const char *kind, const char *word,
                        const char *first, size_t stride, size_t count);

/* Lists the names of a table's rows, NULL-terminated, as the choices of an option: `first` is the
 * name in the first row, stride the bytes from one row to the next; names receives count + 1
 * entries. */
void choice_names(const char *const *first, size_t stride, int count, const char **names);

/* Writes "what: NAME HELP, NAME HELP", the help of an option that chooses a table's row; name and
 * help are those of the first row. Returns text. */
const char *choice_help(const char *what, const char *const *name, const char *const *help,
                        size_t stride, int count, char *text, size_t size);

/* Returns the entry of `names` (NULL-terminated) nearest to `word`, or NULL if none is near. */
const char *choice_nearest(const char *word, const char *const *names);

#endif
