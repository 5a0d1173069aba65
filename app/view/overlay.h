/* SPDX-License-Identifier: MIT */
/* overlay.h - drawings over the image: statistics, help, messages, marks. Pango lays out the text,
 * so that all scripts are legible. */
#ifndef LAMPION_VIEW_OVERLAY_H
#define LAMPION_VIEW_OVERLAY_H

#include "app/base/error.h"

/* A drawing: premultiplied BGRA as Cairo's ARGB32, rows from the top. Without pixels: memory ran
 * out, or Pango is not installed. */
typedef struct view_drawing {
    int width, height;
    void *pixels;
    void *surface; /* Cairo's; owned */
} view_drawing;
void view_drawing_free(view_drawing *drawing);

/* A row of a panel: a name and its value or, without `value`, a heading. */
typedef struct view_row {
    char name[32], value[160];
    bool chosen;
} view_row;

/* Draws a panel. scale is relative to 96 pixels per inch, as in the functions below. */
view_drawing view_draw_panel(const view_row *rows, int count, double scale);

/* Draws all keys, in columns that fit into width x height if possible. */
view_drawing view_draw_help(int width, int height, double scale);

/* Draws one line in a rounded box, at most `width` pixels wide. */
view_drawing view_draw_message(const char *text, int width, double scale);

/* Draws a ring of that radius in pixels around the middle of the drawing. */
view_drawing view_draw_ring(double radius, double scale);

/* Writes the version of Pango; returns false if it is not installed. */
bool view_overlay_version(char *text, size_t size, base_error *error);

#endif
