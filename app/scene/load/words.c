/* SPDX-License-Identifier: MIT */
#include "app/scene/load/words.h"

#include "app/scene/world.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SPACE " \t\v\f"

static bool ensure_buffer(word_reader *reader, size_t size) {
    if (reader->capacity >= size)
        return true;
    char *larger = realloc(reader->buffer, 2 * size);
    if (!larger)
        return false;
    reader->buffer = larger;
    reader->capacity = 2 * size;
    return true;
}

bool words_next_line(word_reader *reader, const char *subject, base_error *error) {
    size_t used = 0;
    bool continues = true;
    if (reader->at == reader->end)
        return false;
    while (continues && reader->at < reader->end) {
        const size_t left = (size_t)(reader->end - reader->at);
        const char *stop = memchr(reader->at, '\n', left);
        size_t length = stop ? (size_t)(stop - reader->at) : left;
        if (!ensure_buffer(reader, used + length + 2)) {
            base_fail(error, subject, "does not fit into memory");
            return false;
        }
        memcpy(reader->buffer + used, reader->at, length);
        reader->at += length + (stop ? 1 : 0);
        reader->line++;
        if (length > 0 && reader->buffer[used + length - 1] == '\r')
            length--;
        continues = length > 0 && reader->buffer[used + length - 1] == '\\';
        if (continues)
            reader->buffer[used + length - 1] = ' ';
        used += length;
    }
    reader->buffer[used] = 0;
    reader->words = reader->buffer;
    reader->words[strcspn(reader->words, "#")] = 0;
    return true;
}

char *words_next(word_reader *reader) {
    char *word = reader->words + strspn(reader->words, SPACE);
    const size_t length = strcspn(word, SPACE);
    reader->words = word + length;
    if (*reader->words)
        *reader->words++ = 0;
    return length > 0 ? word : NULL;
}

char *words_rest(word_reader *reader) {
    char *rest = reader->words + strspn(reader->words, SPACE);
    size_t length = strlen(rest);
    while (length > 0 && strchr(SPACE, rest[length - 1]))
        length--;
    rest[length] = 0;
    reader->words = rest + length;
    return rest;
}

bool words_number(const char *word, float *number) {
    char *end;
    if (!word || !*word || word[strspn(word, "0123456789+-.eE")])
        return false;
    *number = strtof(word, &end);
    return !*end && isfinite(*number);
}

/* Reads a coordinate with a single rounding if there is no origin. */
bool words_coordinate(const char *word, double origin, float *coordinate) {
    if (!words_number(word, coordinate))
        return false;
    if (origin != 0.0)
        *coordinate = scene_from_world(origin, strtod(word, NULL));
    return isfinite(*coordinate);
}
