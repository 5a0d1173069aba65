/* SPDX-License-Identifier: MIT */
#include "app/scene/name.h"

#include "app/cli/printable.h"

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
