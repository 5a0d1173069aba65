/* SPDX-License-Identifier: MIT */
#include "app/scene/load/pieces.h"

#include "app/scene/vector.h"

#include <stdlib.h>
#include <string.h>

double piece_triangle_area(const piece_triangle *triangle) {
    const lmp_vec3 *c = triangle->corner;
    return 0.5 * (double)vec_length(vec_cross(vec_sub(c[1], c[0]), vec_sub(c[2], c[0])));
}

typedef struct place {
    lmp_vec3 at;
    uint32_t corner;
} place;

static int compare_floats(float a, float b) {
    return (a > b) - (a < b);
}

static int compare_positions(lmp_vec3 a, lmp_vec3 b) {
    const int x = compare_floats(a.x, b.x), y = compare_floats(a.y, b.y);
    return x ? x : y ? y : compare_floats(a.z, b.z);
}

static int compare_places(const void *a, const void *b) {
    const place *p = a, *q = b;
    return compare_positions(p->at, q->at);
}

bool pieces_number_corners(const piece_triangle *triangles, size_t count, uint32_t *corner) {
    place *places = malloc((3 * count + 1) * sizeof *places);
    if (!places)
        return false;
    for (uint32_t i = 0; i < 3 * count; i++)
        places[i] = (place) { triangles[i / 3].corner[i % 3], i };
    qsort(places, 3 * count, sizeof *places, compare_places);
    uint32_t number = 0;
    for (uint32_t i = 0; i < 3 * count; i++) {
        number += i > 0 && compare_positions(places[i - 1].at, places[i].at) != 0;
        corner[places[i].corner] = number;
    }
    free(places);
    return true;
}

uint32_t pieces_root(uint32_t *joined, uint32_t item) {
    while (joined[item] != item)
        item = joined[item] = joined[joined[item]];
    return item;
}

/* What pieces_sort works with. */
typedef struct sorting {
    piece_triangle *sorted;
    uint32_t *corner; /* per corner the number of its position */
    uint32_t *joined; /* per position another of its piece, or itself */
    uint32_t *number; /* per position that is a root the number of its piece, from 1 */
} sorting;

static uint32_t piece_of(const sorting *s, uint32_t triangle) {
    return pieces_root(s->joined, s->corner[3 * triangle]);
}

static void join_corners(sorting *s, size_t count) {
    for (uint32_t i = 0; i < 3 * count; i++)
        s->joined[i] = i;
    for (uint32_t i = 0; i < 3 * count; i++)
        s->joined[pieces_root(s->joined, s->corner[i])] = piece_of(s, i / 3);
}

/* Numbers the pieces in the order of their first triangles; returns how many there are. */
static uint32_t number_pieces(sorting *s, size_t count) {
    uint32_t pieces = 0;
    for (uint32_t t = 0; t < count; t++) {
        uint32_t *number = &s->number[piece_of(s, t)];
        if (*number == 0)
            *number = ++pieces;
    }
    return pieces;
}

/* Moves the triangles to their pieces. */
static void move(sorting *s, piece_triangle *triangles, size_t count, piece *pieces,
                 uint32_t piece_count) {
    for (uint32_t t = 0; t < count; t++)
        pieces[s->number[piece_of(s, t)] - 1].count++;
    piece_triangle *first = triangles;
    for (uint32_t i = 0; i < piece_count; i++) {
        pieces[i].triangles = first;
        first += pieces[i].count;
        pieces[i].count = 0;
    }
    memcpy(s->sorted, triangles, count * sizeof *triangles);
    for (uint32_t t = 0; t < count; t++) {
        piece *to = &pieces[s->number[piece_of(s, t)] - 1];
        to->triangles[to->count++] = s->sorted[t];
    }
}

bool pieces_sort(piece_triangle *triangles, size_t count, piece **pieces, size_t *piece_count) {
    sorting s = { .sorted = malloc((count + 1) * sizeof *s.sorted),
                  .corner = malloc((3 * count + 1) * sizeof *s.corner),
                  .joined = malloc((3 * count + 1) * sizeof *s.joined),
                  .number = calloc(3 * count + 1, sizeof *s.number) };
    *pieces = NULL;
    *piece_count = 0;
    if (s.sorted && s.corner && s.joined && s.number &&
        pieces_number_corners(triangles, count, s.corner)) {
        join_corners(&s, count);
        const uint32_t made = number_pieces(&s, count);
        *pieces = calloc(made + 1u, sizeof **pieces);
        if (*pieces) {
            move(&s, triangles, count, *pieces, made);
            *piece_count = made;
        }
    }
    free(s.sorted);
    free(s.corner);
    free(s.joined);
    free(s.number);
    return *pieces != NULL;
}
