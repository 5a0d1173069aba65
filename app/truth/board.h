/* SPDX-License-Identifier: MIT */
/* board.h - formulas compared with the reference values: their accuracy and their cost. */
#ifndef LAMPION_TRUTH_BOARD_H
#define LAMPION_TRUTH_BOARD_H

#include "app/base/cli.h"
#include "app/truth/ruler_figures.h"
#include "app/truth/ruler_group.h"
#include "app/truth/scoreboard_formula.h"

typedef struct board_score {
    const formula *by;
    double *values;                      /* for the table's rows that the formula applies to */
    double nanoseconds[RULER_MATERIALS]; /* of one evaluation, on one core; 0: it does not apply */
} board_score;

typedef struct board {
    const ruler_table *table;
    const cosines_table *published; /* read from a file, or NULL */
    board_score *scores;
    int count;
    double *errors; /* room for a cell's errors */
} board;

/* Evaluates the named formulas, or all if no names are given. What both tables point to must
 * outlive the board. Without `published`, formulas that read it are skipped, unless they are named:
 * then the call fails. */
bool board_create(const ruler_table *table, const cli_list *names, const cosines_table *published,
                  board *result, base_error *error);
void board_free(board *b);

/* A selection of a score's rows: one group of each grouping whose entry is not below 0. */
typedef struct board_cell {
    const formula *by;
    int group[RULER_GROUPINGS];
} board_cell;
board_cell board_all(const board_score *score);

/* Return a cell's statistics, the median of its absolute errors, and the row with the largest error
 * (NULL: there is none). */
ruler_figures board_figures(const board *b, const board_score *score, const board_cell *cell);
double board_median(const board *b, const board_score *score, const board_cell *cell);
const ruler_row *board_worst(const board *b, const board_score *score, const board_cell *cell);

#endif
