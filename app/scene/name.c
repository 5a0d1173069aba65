/* SPDX-License-Identifier: MIT */
#include "app/scene/name.h"

#include "app/cli/printable.h"

#include <stdlib.h>
#include <string.h>

void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text) {
    size_t used = 0;
    memset(name, 0, SCENE_NAME_SIZE);
    while (*text) {
        const size_t length = cli_printable(text), bytes = length ? length : 1;
        if (used + bytes >= SCENE_NAME_SIZE)
            return;
        if (length)
            memcpy(name + used, text, length);
        else
            name[used] = '?';
        used += bytes;
        text += bytes;
    }
}

bool scene_find_name(const char *subject, const char *kind, const char *wanted, const char *first,
                     size_t stride, size_t count, size_t *index, cli_error *error) {
    const bool whole = *wanted && !wanted[strspn(wanted, "0123456789")];
    const unsigned long number = strtoul(wanted, NULL, 10);
    for (*index = 0; *index < count; ++*index)
        if (strcmp(first + *index * stride, wanted) == 0)
            return true;
    *index = whole && number < count ? (size_t)number : count;
    return *index < count || cli_fail_member(error, subject, kind, wanted, first, stride, count);
}
