/* SPDX-License-Identifier: MIT */
/* board.h - formulas judged by the ruler: how far they are from the truth, and what they cost. */
#ifndef LAMPION_SCOREBOARD_BOARD_H
#define LAMPION_SCOREBOARD_BOARD_H

#include "app/ruler/figures.h"
#include "app/ruler/group.h"
#include "app/scoreboard/formula.h"

typedef struct board_score {
    const formula *by;
    double *values;                      /* of the table's rows that it applies to */
    double nanoseconds[RULER_MATERIALS]; /* of one evaluation, on one core; 0: it does not apply */
} board_score;

typedef struct board {
    const ruler_table *table;
    board_score *scores;
    int count;
    double *errors; /* space for a cell's */
} board;

/* Judges the formulas of these names, all if there are none. */
bool board_create(const ruler_table *table, const cli_list *names, board *result, cli_error *error);
void board_free(board *b);

/* Which rows of a score: a group of each grouping that is not below 0. */
typedef struct board_cell {
    const formula *by;
    int group[RULER_GROUPINGS];
} board_cell;
board_cell board_all(const board_score *score);

/* The figures of a cell, the median of its errors without their signs, and the row of the largest
 * (NULL: there is none). */
ruler_figures board_figures(const board *b, const board_score *score, const board_cell *cell);
double board_median(const board *b, const board_score *score, const board_cell *cell);
const ruler_row *board_worst(const board *b, const board_score *score, const board_cell *cell);

#endif
