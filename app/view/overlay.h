/* SPDX-License-Identifier: MIT */
/* overlay.h - drawings over the image: statistics, help, messages, marks. Text by Pango, so that
 * any script of any language is legible. */
#ifndef LAMPION_VIEW_OVERLAY_H
#define LAMPION_VIEW_OVERLAY_H

#include <stdbool.h>

/* Premultiplied BGRA as Cairo's ARGB32, rows from the top. Without pixels: out of memory. */
typedef struct view_drawing {
    int width, height;
    void *pixels;
    void *surface; /* Cairo's; owned */
} view_drawing;
void view_drawing_free(view_drawing *drawing);

/* A row of a panel: a name and what it is; without `value` a heading. */
typedef struct view_row {
    char name[32], value[160];
    bool chosen;
} view_row;

/* scale: of a pixel of 96 a inch, here and below. */
view_drawing view_draw_panel(const view_row *rows, int count, double scale);

/* All keys, in columns that fit into width x height if that can be. */
view_drawing view_draw_help(int width, int height, double scale);

/* One line in a rounded box, at most `width` pixels wide. */
view_drawing view_draw_message(const char *text, int width, double scale);

/* A ring of that radius in pixels, around the middle of the drawing. */
view_drawing view_draw_ring(double radius, double scale);

#endif
