/* SPDX-License-Identifier: MIT */
#include "app/image/sequence.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Finds the first %d or %0Nd in the pattern; *rest is the text after it. Returns NULL if there is
 * none. */
static const char *find_number(const char *pattern, int *digits, const char **rest) {
    for (const char *at = strchr(pattern, '%'); at; at = strchr(at + 1, '%')) {
        const char *end = at + 1 + strspn(at + 1, "0123456789");
        if (*end != 'd' || end - at > 3)
            continue;
        *digits = atoi(at + 1);
        *rest = end + 1;
        return at;
    }
    return NULL;
}

bool image_sequence_has_number(const char *pattern) {
    int digits;
    const char *rest;
    return find_number(pattern, &digits, &rest) != NULL;
}

void image_sequence_name(const char *pattern, int index, char *path, size_t size) {
    int digits = 4;
    const char *rest = strrchr(pattern, '.');
    const char *number = find_number(pattern, &digits, &rest);
    const char *separator = number ? "" : "_";
    const int before = (int)((number ? number : rest) - pattern);
    snprintf(path, size, "%.*s%s%0*d%s", before, pattern, separator, digits, index, rest);
}
