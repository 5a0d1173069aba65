/* SPDX-License-Identifier: MIT */
/* ui.h - the interface over the image, drawn by Dear ImGui; the library is C++, and this is its
 * interface to C. There is one at a time. Lengths and places are in pixels, from the upper left
 * corner. */
#ifndef LAMPION_VIEW_UI_H
#define LAMPION_VIEW_UI_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Begins an interface: in the current OpenGL context or, without `draws`, one that is laid out but
 * not drawn. The clipboard is reached by `copy` and `paste`, or NULL. Returns false if OpenGL's
 * functions cannot be loaded. */
bool ui_open(bool draws, void (*copy)(const char *text), const char *(*paste)(void));
void ui_close(void);

/* Begin and end a frame, in which everything is described anew. `scale` is relative to 96 pixels
 * per inch. ui_end returns a hash of what is drawn: frames of the same hash look the same. */
void ui_begin(int width, int height, double scale, double seconds);
uint64_t ui_end(void);

/* Draws the last frame over the image in the current framebuffer, with as many pixels. */
void ui_draw(void);

const char *ui_version(void);

/* --- input: what the next frame is described for ---------------------------------------------- */

void ui_move(double x, double y);
void ui_press(int button, bool down); /* 0 left, 1 middle, 2 right */
void ui_scroll(double steps);
void ui_type(const char *text);

/* Presses or releases a key, such as Enter or Shift+Left; returns false if it has no meaning. */
bool ui_key(const char *name, bool down);

/* Whether the last frame has something at a place, where the pointer is, or a field for text that
 * is active. */
bool ui_covers(double x, double y);
bool ui_covered(void);
bool ui_takes_text(void);

/* --- widgets ---------------------------------------------------------------------------------- */

/* Begins the sidebar, at the right edge. Unless it is open, only its title is there, which opens
 * it. Returns whether what is in it is seen; ui_sidebar_end follows in any case. */
bool ui_sidebar_begin(const char *title, double width, bool *open);
void ui_sidebar_end(void);

/* Adds a heading that folds, at first open or not; returns whether what is below it is seen. */
bool ui_section(const char *title, bool open);

/* Adds a button, beside others if there is room, that shows whether what it switches is on; returns
 * whether it was pressed. */
bool ui_button(const char *name, const char *tip, bool on);

/* Adds a line of text. */
void ui_text(const char *text);

/* Add fields, which return whether they changed the value. What follows ## in a name is not shown,
 * but makes it another field. Numbers are dragged, by `step` a pixel, or typed after a double
 * click. */
bool ui_numbers(const char *name, float *numbers, int count, float minimum, float maximum,
                float step);
bool ui_integer(const char *name, int *number, int minimum, int maximum);
bool ui_flag(const char *name, bool *on);
bool ui_choice(const char *name, const char *const *choices, int *chosen);

/* Adds a color, 0 … 1 and linear, to be picked; what comes next is beside it. */
bool ui_tint(const char *name, float rgb[3]);

/* Adds a field for text of at most `size` bytes. Returns whether Enter was pressed in it or, if it
 * is `live`, whether the text changed. */
bool ui_line(const char *name, char *text, size_t size, bool live);

/* Adds a list that shows that many rows; then its items. */
void ui_list_begin(const char *name, int rows);

/* Whether the next item is seen; if not, its place is left empty. */
bool ui_sees_item(void);

/* Scrolls the list so that the next item is seen in the next frame. */
void ui_reveal_item(void);

/* Adds an item; returns whether it was chosen. If the list is too narrow for it, pointing at it
 * shows all of it. */
bool ui_item(const char *text, bool chosen);

/* Adds an item of a tree, by its number, at a depth; one with items below it can be opened. */
bool ui_tree_item(long number, const char *text, int depth, bool has_more, bool chosen);
bool ui_is_open(long number);
void ui_open_item(long number);
void ui_list_end(void);

/* Adds an image of size x size pixels, 0 … 1 and linear; pixels below 0 are left out. */
void ui_image(const float *rgb, int size);

void ui_graph(const char *name, const float *numbers, int count, float maximum);

/* Finds the middle of a heading, button or field of the last frame; returns false if it is not
 * seen. */
bool ui_find(const char *name, double *x, double *y);

/* --- drawings --------------------------------------------------------------------------------- */

typedef enum ui_color {
    UI_INK,
    UI_PALE,
    UI_ACCENT,
    UI_PAPER,
    UI_SOLID_PAPER,
    UI_RED,
    UI_GREEN,
    UI_BLUE
} ui_color;

/* Returns the height of text. */
double ui_text_height(void);

/* Measures a text; `size` is relative to the interface's. It breaks at `room` pixels, or 0: only
 * where it has a line break. */
void ui_measure(const char *text, double size, double room, double *width, double *height);

void ui_write(double x, double y, const char *text, double size, double room, ui_color color);
void ui_box(double x, double y, double width, double height, double radius, ui_color color);

/* Draws a path through points: open, closed, or filled if it is convex; its edge is dark, to be
 * seen on anything. */
typedef enum ui_shape { UI_OPEN, UI_CLOSED, UI_FILLED } ui_shape;
void ui_path(const float (*points)[2], int count, ui_shape shape, double width, ui_color color,
             double opacity);

#ifdef __cplusplus
}
#endif

#endif
