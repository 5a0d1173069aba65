/* SPDX-License-Identifier: MIT */
/* scoreboard_plates.h - a metal plate under a sphere, by the reference and by each formula of a
 * scoreboard. */
#ifndef LAMPION_TRUTH_SCOREBOARD_PLATES_H
#define LAMPION_TRUTH_SCOREBOARD_PLATES_H

#include "app/truth/board.h"

/* Draws numbered cells: 0 the truth, then the formulas that support metals, in their order. Below
 * each plate is its difference, red for too bright and blue for too dark, saturated at PLATES_FULL
 * of the truth's peak. */
#define PLATES_FULL 0.5
bool plates_write(const board *b, const char *path, base_error *error);

#endif
