/* SPDX-License-Identifier: MIT */
/* overlay.h - what is drawn over the image besides the panel: statistics, help, messages, marks.
 * Within a frame of the interface (app/view/ui.h). */
#ifndef LAMPION_VIEW_OVERLAY_H
#define LAMPION_VIEW_OVERLAY_H

#include "app/view/ui.h"

/* A row of a box: a name and its value or, without `value`, a heading. */
typedef struct view_row {
    char name[32], value[160];
    bool chosen;
} view_row;

/* A box in pixels, and where its text begins. */
typedef struct view_box {
    double x, y, width, height;
} view_box;

/* Draws rows in a box at x, y; `pivot` is the fraction of the width that lies left of x. */
view_box view_draw_rows(const view_row *rows, int count, double x, double y, double pivot,
                        ui_color paper);

/* Draws all keys in the middle of an image, in columns, as large as it has room for; where that is
 * too small to be read, in one column that is moved up by *scroll pixels, as far as it goes. */
view_box view_draw_help(int width, int height, double *scroll);

/* Draws a text in a box at most `room` wide whose lower edge is at y. */
view_box view_draw_message(const char *text, double room, double x, double y, double pivot);

#endif
