/* SPDX-License-Identifier: MIT */
/* panel.h - panels for typed values: those of the selected light, the scene's materials, or the
 * name of a file to open. */
#ifndef LAMPION_VIEW_PANEL_H
#define LAMPION_VIEW_PANEL_H

#include "app/view/overlay.h"
#include "app/view/state.h"

enum { VIEW_PANEL_ROWS = 16 };

/* Opens the panel of the selected light or, in the other function, of the materials, at the one
 * under the pointer; closes any open panel. */
void view_toggle_panel(view_state *state, int unused);

/* Opens the panel that asks for a file. */
void view_ask_file(view_state *state, int unused);

/* Handles a key if the open panel uses it; returns whether it does. */
bool view_panel_take_key(view_state *state, const char *key);

/* Lists what the panel shows, a heading and the rows around the selected one; returns how many. */
int view_panel_rows(const view_state *state, view_row rows[VIEW_PANEL_ROWS]);

#endif
