/* SPDX-License-Identifier: MIT */
/* nodes.h - the nodes of a scene: selected, framed, hidden, with all that is below them. What is
 * hidden is drawn, picked and casts shadows as if it were not there; its light stays. */
#ifndef LAMPION_VIEW_NODES_H
#define LAMPION_VIEW_NODES_H

#include "app/view/state.h"

/* Act on the selected node, or on what is under the pointer; all show what happened. */
void view_pick_node(view_state *state, int unused);
void view_frame_node(view_state *state, int unused);
void view_hide_node(view_state *state, int unused); /* or shows it again */
void view_isolate_node(view_state *state, int unused);
void view_show_nodes(view_state *state, int unused); /* all of them */

/* Whether everything below a node is hidden. */
bool view_node_is_hidden(const view_state *state, size_t node);

/* Returns the scene without what the settings, or NULL, hide, which shares all else with the whole
 * one and must not outlive it; NULL on failure. Free with view_part_free. */
scene *view_part_make(const scene *whole, const view_settings *settings, base_error *error);
void view_part_free(scene *part);

#endif
