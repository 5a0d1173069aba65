/* SPDX-License-Identifier: MIT */
#include "app/scene/name.h"

#include "app/base/choice.h"
#include "app/base/printable.h"

#include <stdlib.h>
#include <string.h>

void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text) {
    size_t used = 0;
    memset(name, 0, SCENE_NAME_SIZE);
    while (*text) {
        const size_t length = printable_length(text), bytes = length ? length : 1;
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
                     size_t stride, size_t count, size_t *index, base_error *error) {
    const bool whole = *wanted && !wanted[strspn(wanted, "0123456789")];
    const unsigned long number = strtoul(wanted, NULL, 10);
    for (*index = 0; *index < count; ++*index)
        if (strcmp(first + *index * stride, wanted) == 0)
            return true;
    *index = whole && number < count ? (size_t)number : count;
    return *index < count || choice_fail_member(error, subject, kind, wanted, first, stride, count);
}
