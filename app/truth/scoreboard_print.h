/* SPDX-License-Identifier: MIT */
/* scoreboard_print.h - a scoreboard as tables for people and machines, and as a plot. */
#ifndef LAMPION_TRUTH_SCOREBOARD_PRINT_H
#define LAMPION_TRUTH_SCOREBOARD_PRINT_H

#include "app/truth/board.h"

/* Prints the scores by material, then those of metals by roughness, size and view. */
void board_print_text(const board *b);

/* Prints one record per formula, material, roughness, half angle and view, and one for each formula
 * and material as a whole. */
void board_print_csv(const board *b);
void board_print_json(const board *b);

/* Plots error over cost for a material. */
bool board_plot(const board *b, ruler_material material, const char *path, base_error *error);

#endif
