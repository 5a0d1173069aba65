/* SPDX-License-Identifier: MIT */
/* panel.h - values that are typed: those of the selected light, the scene's materials, or the name
 * of a file to open. */
#ifndef LAMPION_VIEW_PANEL_H
#define LAMPION_VIEW_PANEL_H

#include "app/view/overlay.h"
#include "app/view/state.h"

enum { VIEW_PANEL_ROWS = 16 };

/* Opens that of the selected light, or that of the materials at the one pointed at; closes any. */
void view_toggle_panel(view_state *state, int unused);

/* Opens the one that asks for a file. */
void view_ask_file(view_state *state, int unused);

/* Takes a key that an open panel has a use for. */
bool view_panel_take_key(view_state *state, const char *key);

/* What it shows: a heading, then the rows around the chosen one. Returns how many. */
int view_panel_rows(const view_state *state, view_row rows[VIEW_PANEL_ROWS]);

#endif
