/* SPDX-License-Identifier: MIT */
/* plates.h - a metal plate under a sphere, by the truth and by each formula of a scoreboard. */
#ifndef LAMPION_SCOREBOARD_PLATES_H
#define LAMPION_SCOREBOARD_PLATES_H

#include "app/scoreboard/board.h"

/* Numbered cells: 0 the truth, then the formulas that know metals in their order. Below each plate
 * its difference, red too bright and blue too dark, full at PLATES_FULL of the truth's peak. */
#define PLATES_FULL 0.5
bool plates_write(const board *b, const char *path, cli_error *error);

#endif
