/* SPDX-License-Identifier: MIT */
#include "app/base/printable.h"

#include <stdbool.h>
#include <stdio.h>

/* Returns how many bytes the UTF-8 character that begins with `first` has, or 0 if none does. */
static size_t length_of(unsigned char first) {
    return first < 0x80                    ? 1
           : first >= 0xC2 && first < 0xE0 ? 2
           : first >= 0xE0 && first < 0xF0 ? 3
           : first >= 0xF0 && first < 0xF5 ? 4
                                           : 0;
}

/* Whether a code point decoded from `length` bytes is a character: overlong forms, surrogates and
 * code points beyond Unicode's last are not. */
static bool is_character(uint32_t code, size_t length) {
    static const uint32_t least[] = { 0, 0, 0x80, 0x800, 0x10000 };
    return code >= least[length] && !(code >= 0xD800 && code < 0xE000) && code < 0x110000;
}

/* Whether a terminal would act on a character instead of showing it. */
static bool is_obeyed(uint32_t code) {
    const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool turns = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) ||
                       code == 0x200E || code == 0x200F || code == 0x061C;
    return control || turns;
}

size_t printable_character(const char *text, uint32_t *character) {
    const unsigned char *const c = (const unsigned char *)text;
    const size_t length = length_of(c[0]);
    uint32_t code = length > 1 ? c[0] & 0x7Fu >> length : c[0];
    for (size_t i = 1; i < length; i++) {
        if ((c[i] & 0xC0) != 0x80)
            return 0;
        code = code << 6 | (c[i] & 0x3Fu);
    }
    *character = code;
    return length > 0 && is_character(code, length) ? length : 0;
}

size_t printable_length(const char *text) {
    uint32_t code;
    const size_t length = printable_character(text, &code);
    return length > 0 && !is_obeyed(code) ? length : 0;
}

void printable_print(const char *name) {
    while (*name) {
        const size_t length = printable_length(name), bytes = length ? length : 1;
        fwrite(length ? name : "?", 1, bytes, stdout);
        name += bytes;
    }
}
