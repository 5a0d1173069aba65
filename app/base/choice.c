/* SPDX-License-Identifier: MIT */
#include "app/base/choice.h"

#include <stdio.h>
#include <string.h>

#define WORD_MAX 40 /* longer words are never suggested for */

static size_t smaller(size_t a, size_t b) {
    return a < b ? a : b;
}

/* Edits (insert, delete, replace, swap neighbors) that turn one word into the other. */
static size_t edit_distance(const char *a, size_t a_length, const char *b, size_t b_length) {
    size_t rows[3][WORD_MAX + 1];
    size_t *before = rows[0], *above = rows[1], *row = rows[2];
    for (size_t j = 0; j <= b_length; j++)
        above[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t edited = smaller(row[j - 1], above[j]) + 1;
            row[j] = smaller(edited, above[j - 1] + (a[i - 1] != b[j - 1]));
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = smaller(row[j], before[j - 2] + 1);
        }
        size_t *const recycled = before;
        before = above;
        above = row;
        row = recycled;
    }
    return above[b_length];
}

const char *choice_nearest(const char *word, const char *const *names) {
    const size_t length = strlen(word);
    if (length == 0 || length > WORD_MAX)
        return NULL;
    const char *nearest = NULL;
    size_t least = length / 3 + 2; /* one edit in a short word, more in a long one */
    for (; *names; names++) {
        const size_t name_length = strlen(*names);
        if (name_length > WORD_MAX)
            continue;
        const bool begun = length > 1 && strncmp(word, *names, length) == 0;
        const size_t distance = begun ? 1 : edit_distance(word, length, *names, name_length);
        if (distance < least && distance < name_length) {
            least = distance;
            nearest = *names;
        }
    }
    return nearest;
}

bool choice_fail(base_error *error, const char *subject, const char *word,
                 const char *const *names) {
    char known[512] = "";
    size_t length = 0;
    for (size_t i = 0; names[i] && length < sizeof known - 1; i++)
        length += (size_t)snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "",
                                   names[i][0] ? names[i] : "\"\"");
    if (length >= sizeof known)
        memcpy(known + sizeof known - 4, "...", 4);
    const char *const nearest = choice_nearest(word, names);
    return base_fail(error, subject, "\"%s\" is not one of %s%s%s%s", word, known,
                     nearest ? " (did you mean " : "", nearest ? nearest : "", nearest ? "?)" : "");
}

bool choice_fail_member(base_error *error, const char *subject, const char *kind, const char *word,
                        const char *first, size_t stride, size_t count) {
    enum { NAMES = 64 };
    const char *names[NAMES + 1] = { NULL };
    char where[512];
    for (size_t i = 0; i < count && i < NAMES; i++)
        names[i] = first + i * stride;
    snprintf(where, sizeof where, "%.400s: no such %s", subject, kind);
    return count ? choice_fail(error, where, word, names)
                 : base_fail(error, where, "\"%s\", for there is none", word);
}

/* Returns the member of row `index` of a table; `first` is that member of the first row. */
static const char *row_member(const char *const *first, size_t stride, int index) {
    return *(const char *const *)(const void *)((const char *)first + (size_t)index * stride);
}

void choice_names(const char *const *first, size_t stride, int count, const char **names) {
    for (int i = 0; i < count; i++)
        names[i] = row_member(first, stride, i);
    names[count] = NULL;
}

const char *choice_help(const char *what, const char *const *name, const char *const *help,
                        size_t stride, int count, char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "%s", what);
    for (int i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s %s", i ? ", " : ": ",
                                 row_member(name, stride, i), row_member(help, stride, i));
    return text;
}
