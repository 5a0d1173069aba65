/* SPDX-License-Identifier: MIT */
/* window.h - a window with a context, and its input as events; only this module uses GLFW. A key
 * that types no character is a row of `names` in window.c, what keys do are rows of keys.c. */
#ifndef LAMPION_VIEW_WINDOW_H
#define LAMPION_VIEW_WINDOW_H

#include "app/view/state.h"

typedef struct view_window view_window;

/* Takes an event; `to` is what view_window_open was given. */
typedef void view_listener(void *to, const view_event *event);

/* Opens a window and makes its context current. Events go to the listener. Returns NULL on failure;
 * without a display the error suggests what to do instead. */
view_window *view_window_open(const char *title, int width, int height, view_listener *listener,
                              void *to, base_error *error);
void view_window_close(view_window *window);

/* Disconnects from the display; before that, another window may be opened on the same
 * connection. */
void view_window_end(void);

/* Handles pending events; waits up to `seconds` for one. */
void view_window_take_events(view_window *window, double seconds);

/* Finds the pixels of the image; returns false if there are none: the window is minimized. */
bool view_window_size(const view_window *window, int *width, int *height);

/* Returns the scale of the display relative to 96 pixels per inch. */
double view_window_scale(const view_window *window);

void view_window_resize(view_window *window, int width, int height); /* in pixels */
void view_window_title(view_window *window, const char *title);
void view_window_toggle_fullscreen(view_window *window);
void view_window_swap(view_window *window);

/* The clipboard of the desktop. */
void view_window_copy(const char *text);
const char *view_window_paste(void);

/* Returns the seconds since the first window was opened. */
double view_window_clock(void);

/* Writes the version of GLFW; returns false if it is not installed. */
bool view_window_version(char *text, size_t size, base_error *error);

#endif
