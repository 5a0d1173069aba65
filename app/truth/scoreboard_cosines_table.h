/* SPDX-License-Identifier: MIT */
/* scoreboard_cosines_table.h - GGX as linearly transformed cosines: the fit to glTF's GGX by
 * tests/ruler/generate_cosines.c, and tables of others. */
#ifndef LAMPION_TRUTH_SCOREBOARD_COSINES_TABLE_H
#define LAMPION_TRUTH_SCOREBOARD_COSINES_TABLE_H

#include "app/base/error.h"

/* Of size² nodes: row i is roughness i / (size - 1), column j the view of cosine 1 - (j / (size -
 * 1))². Of a node: four members of the inverse matrix whose middle one is 1,
 *
 *     a 0 b
 *     0 1 0    in a frame of x toward the viewer's side and z the normal,
 *     c 0 d
 *
 * then the integrals of D V cos and of the same times (1 - v·h)^5. */
#define COSINES_SIZE    32
#define COSINES_MEMBERS 6
typedef struct cosines_table {
    int size;
    const float (*nodes)[COSINES_MEMBERS];
    float (*own)[COSINES_MEMBERS]; /* to be freed, or NULL */
} cosines_table;

extern const float cosines_nodes[COSINES_SIZE * COSINES_SIZE][COSINES_MEMBERS];
extern const cosines_table cosines_fitted; /* made of cosines_nodes */

/* Reads a table in the JavaScript form in which Heitz et al. and their successors publish it: two
 * bracketed lists of 4 numbers per node, roughness running fastest, first a, c, b and d, then the
 * integrals of GGX with a Fresnel term of 1, and of its part (1 - v·h)^5; the last two numbers of a
 * node are ignored. text ends with a NUL. Free with cosines_free. */
bool cosines_read(const char *path, cosines_table *table, base_error *error);
bool cosines_parse(const char *path, const char *text, size_t size, cosines_table *table,
                   base_error *error);
void cosines_free(cosines_table *table);

#endif
