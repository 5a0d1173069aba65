/* SPDX-License-Identifier: MIT */
/* window.h - a window with a context, and its input as events: all that knows GLFW. */
#ifndef LAMPION_VIEW_WINDOW_H
#define LAMPION_VIEW_WINDOW_H

#include "app/view/state.h"

typedef struct view_window view_window;

/* Opens a window and makes its context current. Events go to `state`. NULL on failure: without a
 * display the error says what to do instead. */
view_window *view_window_open(const char *title, int width, int height, view_state *state,
                              cli_error *error);
void view_window_close(view_window *window);

/* Leaves the display; another window may be opened before, on the same connection to it. */
void view_window_end(void);

/* Takes what has happened; waits up to `seconds` for something to happen. */
void view_window_take_events(view_window *window, double seconds);

/* Pixels of the image; false if there are none: minimized. */
bool view_window_size(const view_window *window, int *width, int *height);

/* Of a pixel of 96 an inch. */
double view_window_scale(const view_window *window);

void view_window_resize(view_window *window, int width, int height); /* in pixels */
void view_window_title(view_window *window, const char *title);
void view_window_toggle_fullscreen(view_window *window);
void view_window_swap(view_window *window);

/* Seconds since the first window. */
double view_window_clock(void);

#endif
