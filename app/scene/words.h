/* SPDX-License-Identifier: MIT */
/* words.h - text files of statements: one a line, words apart by spaces and tabs, as OBJ and MTL
 * are. */
#ifndef LAMPION_SCENE_WORDS_H
#define LAMPION_SCENE_WORDS_H

#include "app/cli/cli.h"

typedef struct word_reader {
    const char *at, *end; /* of the text */
    size_t line;          /* the last one read, from 1 */
    char *words;          /* the rest of the line; NUL-terminated */
    size_t capacity;
    char *buffer; /* to be freed */
} word_reader;

/* Reads the next line, joined with those that it continues in by a backslash at its end, and
 * without its comment. False at the end of the text, or without memory: *error then says so. */
bool words_next_line(word_reader *reader, const char *subject, cli_error *error);

/* The next word of the line; NULL after the last. */
char *words_next(word_reader *reader);

/* What is left of the line, without the space at its ends: for names that may hold spaces. */
char *words_rest(word_reader *reader);

/* The word as a decimal number, all of it and finite. */
bool words_number(const char *word, float *number);

/* The same of a coordinate of the world, as one of a scene with that origin. */
bool words_coordinate(const char *word, double origin, float *coordinate);

#endif
