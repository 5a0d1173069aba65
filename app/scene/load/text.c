/* SPDX-License-Identifier: MIT */
#include "app/scene/load/text.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define REPLACEMENT 0xfffdu

static uint32_t unit(const unsigned char *bytes, bool big) {
    return big ? (uint32_t)bytes[0] << 8 | bytes[1] : (uint32_t)bytes[1] << 8 | bytes[0];
}

static size_t put(uint32_t c, unsigned char *out) {
    if (c < 0x80) {
        out[0] = (unsigned char)c;
        return 1;
    }
    const size_t more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    static const unsigned char first[] = { 0, 0xc0, 0xe0, 0xf0 };
    out[0] = (unsigned char)(first[more] | c >> 6 * more);
    for (size_t i = 1; i <= more; i++)
        out[i] = (unsigned char)(0x80 | (c >> 6 * (more - i) & 0x3f));
    return more + 1;
}

bool text_to_utf8(void **data, size_t *size) {
    const unsigned char *from = *data;
    if (*size < 2 ||
        !((from[0] == 0xff && from[1] == 0xfe) || (from[0] == 0xfe && from[1] == 0xff)))
        return true;
    const bool big = from[0] == 0xfe;
    /* a unit of two bytes becomes three at most, and two units four */
    unsigned char *const to = malloc(*size / 2 * 3 + 1);
    size_t used = 0;
    if (!to)
        return false;
    for (size_t i = 2; i + 1 < *size; i += 2) {
        uint32_t c = unit(from + i, big);
        if (c >= 0xd800 && c < 0xdc00 && i + 3 < *size) {
            const uint32_t low = unit(from + i + 2, big);
            if (low >= 0xdc00 && low < 0xe000) {
                c = 0x10000 + ((c - 0xd800) << 10) + (low - 0xdc00);
                i += 2;
            }
        }
        used += put(c >= 0xd800 && c < 0xe000 ? REPLACEMENT : c, to + used);
    }
    free(*data);
    *data = to;
    *size = used;
    return true;
}

size_t text_trim_xml(char *text, size_t size) {
    size_t used = 0;
    for (size_t i = 0; i < size; i++) {
        if (used > 0 && text[used - 1] == '>' && text[i] && strchr(" \t\r\n", text[i]))
            continue;
        text[used++] = text[i];
    }
    return used;
}
