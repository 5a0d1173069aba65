/* SPDX-License-Identifier: MIT */
/* sort.c - sorts surfaces by their lobes and cells: those shaded together then read the same nodes,
 * and have the same lights near them. */
#include "src/field/sort.h"

#include <assert.h>
#include <stdbool.h>
#include <string.h>

/* The words sorted hold a key, and the surface's index in the low bits. */
enum { INDEX = 10, DIGIT = 8, DIGITS = 1 << DIGIT };
static_assert(1 << INDEX == FIELD_SORTED && INDEX + 2 * DIGIT < 32, "keys have three digits");

/* Sorts stably by one digit; returns false if all words share it, as often, because few blocks lie
 * close together. */
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

/* Sorts runs of equal keys, because neighbors often share one. */
void lmpi_field_sort(const uint32_t *keys, size_t count, uint16_t *order) {
    uint32_t words[2][FIELD_SORTED];
    uint16_t from[FIELD_SORTED], end[FIELD_SORTED];
    size_t runs = 0, sorted = 0;
    int at = 0;
    for (size_t i = 0, start = 0; i < count; i++) {
        from[i] = order[i];
        if (i == 0 || keys[from[i]] != keys[from[i - 1]]) {
            start = i;
            words[0][runs++] = keys[from[i]] << INDEX | (uint32_t)i;
        }
        end[start] = (uint16_t)(i + 1);
    }
    for (int shift = INDEX; shift < 32 && runs > 1; shift += DIGIT)
        if (sort_digit(words[at], runs, shift, words[1 - at]))
            at = 1 - at;
    for (size_t r = 0; r < runs; r++) {
        const uint32_t start = words[at][r] & (FIELD_SORTED - 1);
        for (uint32_t i = start; i < end[start]; i++)
            order[sorted++] = from[i];
    }
}
