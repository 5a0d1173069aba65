/* SPDX-License-Identifier: MIT */
#include "app/scene/joined.h"

#include "app/scene/random.h"

#include <stdlib.h>
#include <string.h>

#define NONE UINT32_MAX

static uint64_t hash_of(const float position[3]) {
    uint64_t hash = 0;
    for (int k = 0; k < 3; k++) {
        const float x = position[k] + 0.0f; /* makes both zeros equal */
        uint32_t bits;
        memcpy(&bits, &x, sizeof bits);
        hash += bits;
        hash = random_bits(&hash);
    }
    return hash;
}

static bool is_same(const float a[3], const float b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

size_t joined_slots(size_t count) {
    size_t slots = 64;
    while (slots < 2 * count)
        slots *= 2;
    return slots;
}

bool joined_positions(const scene_vertex *vertices, uint32_t count, uint32_t *first) {
    const size_t slots = joined_slots(count);
    uint32_t *const table = malloc(slots * sizeof *table);
    if (!table)
        return false;
    memset(table, 0xff, slots * sizeof *table);
    for (uint32_t i = 0; i < count; i++) {
        const float *const at = vertices[i].position;
        size_t slot = hash_of(at) & (slots - 1);
        while (table[slot] != NONE && !is_same(vertices[table[slot]].position, at))
            slot = (slot + 1) & (slots - 1);
        if (table[slot] == NONE)
            table[slot] = i;
        first[i] = table[slot];
    }
    free(table);
    return true;
}

static uint32_t leader_of(uint32_t *joined, uint32_t member) {
    while (joined[member] != member) {
        joined[member] = joined[joined[member]];
        member = joined[member];
    }
    return member;
}

void joined_join(uint32_t *joined, uint32_t a, uint32_t b) {
    a = leader_of(joined, a);
    b = leader_of(joined, b);
    joined[a > b ? a : b] = a > b ? b : a;
}

uint32_t joined_number(uint32_t *joined, uint32_t count) {
    uint32_t next = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t from = joined[i];
        joined[i] = from == i ? next++ : joined[from];
    }
    return next;
}
