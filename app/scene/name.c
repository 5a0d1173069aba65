/* SPDX-License-Identifier: MIT */
#include "app/scene/name.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

/* Bytes of the UTF-8 character at text, 0 if it is none (overlong forms and surrogates are none).
 */
static size_t utf8_length(const unsigned char *text) {
    const unsigned char c = text[0];
    const size_t length = c < 0x80                ? 1
                          : c >= 0xc2 && c < 0xe0 ? 2
                          : c >= 0xe0 && c < 0xf0 ? 3
                          : c >= 0xf0 && c < 0xf5 ? 4
                                                  : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    if ((c == 0xe0 && text[1] < 0xa0) || (c == 0xed && text[1] >= 0xa0) ||
        (c == 0xf0 && text[1] < 0x90) || (c == 0xf4 && text[1] >= 0x90))
        return 0;
    return length;
}

void scene_clean_name(char name[SCENE_NAME_SIZE], const char *text) {
    size_t used = 0;
    memset(name, 0, SCENE_NAME_SIZE);
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        const size_t length = utf8_length(c);
        const bool plain = length > 0 && *c >= 0x20 && *c != 0x7f;
        const size_t bytes = plain ? length : 1;
        if (used + bytes >= SCENE_NAME_SIZE)
            return;
        if (plain)
            memcpy(name + used, c, bytes);
        else
            name[used] = '?';
        used += bytes;
        c += bytes;
    }
}
