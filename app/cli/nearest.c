/* SPDX-License-Identifier: MIT */
#include "app/cli/cli.h"

#include <string.h>

#define WORD_MAX 40 /* longer words are near to nothing */

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

const char *cli_nearest(const char *word, const char *const *names) {
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
