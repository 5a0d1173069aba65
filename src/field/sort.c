/* SPDX-License-Identifier: MIT */
/* sort.c - surfaces in the order of their lobes and blocks: those that are shaded together then
 * read the same nodes, and the same lights are near them. */
#include "src/field/field.h"

#include <string.h>

/* What is sorted is a key, then the surface's index in the low bits. */
enum { INDEX = 10, DIGIT = 8, DIGITS = 1 << DIGIT };
static_assert(1 << INDEX == FIELD_SORTED && INDEX + 2 * DIGIT < 32, "keys have three digits");

/* By one digit, stably; whether they differ in it: few blocks lie close together. */
static bool sort_digit(const uint32_t *from, size_t count, int shift, uint32_t *to) {
    uint16_t start[DIGITS] = { 0 }, next = 0;
    for (size_t i = 0; i < count; i++)
        start[from[i] >> shift & (DIGITS - 1)]++;
    if (start[from[0] >> shift & (DIGITS - 1)] == count)
        return false;
    for (size_t d = 0; d < DIGITS; d++) {
        const uint16_t some = start[d];
        start[d] = next;
        next = (uint16_t)(next + some);
    }
    for (size_t i = 0; i < count; i++)
        to[start[from[i] >> shift & (DIGITS - 1)]++] = from[i];
    return true;
}

void lmp_field_sort(const uint32_t *keys, size_t count, uint16_t *order) {
    uint32_t words[2][FIELD_SORTED] = { { 0 } };
    int at = 0;
    for (size_t i = 0; i < count; i++)
        words[0][i] = keys[order[i]] << INDEX | order[i];
    for (int shift = INDEX; shift < 32 && count > 0; shift += DIGIT)
        if (sort_digit(words[at], count, shift, words[1 - at]))
            at = 1 - at;
    for (size_t i = 0; i < count; i++)
        order[i] = (uint16_t)(words[at][i] & (FIELD_SORTED - 1));
}
