/* SPDX-License-Identifier: MIT */
/* words.h - text files of statements, as OBJ and MTL: one per line, words separated by spaces and
 * tabs. */
#ifndef LAMPION_SCENE_LOAD_WORDS_H
#define LAMPION_SCENE_LOAD_WORDS_H

#include "app/base/error.h"

typedef struct word_reader {
    const char *at, *end; /* of the text */
    size_t line;          /* of the line read last, from 1 */
    char *words;          /* the rest of the line; NUL-terminated */
    size_t capacity;
    char *buffer; /* to be freed */
} word_reader;

/* Reads the next line, joined with its continuations after a backslash, without comments. Returns
 * false at the end of the text, or if memory ran out, which *error then says. */
bool words_next_line(word_reader *reader, const char *subject, base_error *error);

/* Returns the next word of the line, or NULL after the last. */
char *words_next(word_reader *reader);

/* Returns the rest of the line, without space at its ends, for names that may contain spaces. */
char *words_rest(word_reader *reader);

/* Reads a word that is a finite decimal number. */
bool words_number(const char *word, float *number);

/* Reads a word that is a world coordinate, and makes it relative to the scene's origin. */
bool words_coordinate(const char *word, double origin, float *coordinate);

#endif
