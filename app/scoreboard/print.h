/* SPDX-License-Identifier: MIT */
/* print.h - a scoreboard as tables for people and machines, and as a plot. */
#ifndef LAMPION_SCOREBOARD_PRINT_H
#define LAMPION_SCOREBOARD_PRINT_H

#include "app/scoreboard/board.h"

/* By material, then of metals by roughness, size and view. */
void board_print_text(const board *b);

/* One record a formula, material, roughness, half angle and view, and one of each formula and
 * material whole. */
void board_print_csv(const board *b);
void board_print_json(const board *b);

/* Error over cost, of a material. */
bool board_plot(const board *b, ruler_material material, const char *path, cli_error *error);

#endif
