/* SPDX-License-Identifier: MIT */
/* lights.h - what keys do to lights: to the selected one, or to all. */
#ifndef LAMPION_VIEW_LIGHTS_H
#define LAMPION_VIEW_LIGHTS_H

#include "app/view/state.h"

/* Change lights. sign > 0: larger, brighter, further around the hue circle, paler. */
void view_resize_lights(view_state *state, int sign);
void view_brighten_lights(view_state *state, int sign);
void view_recolor_lights(view_state *state, int sign);
void view_fade_lights(view_state *state, int sign);

/* Returns the diagonal of a scene's box, above 0. */
float view_scene_diagonal(const scene *world);

void view_select_light(view_state *state, int step);

/* Adds a light over the surface under the pointer; the next ones act on the selected light only. */
void view_add_light(view_state *state, int unused);

/* Adds a copy of the selected light beside it. */
void view_copy_light(view_state *state, int unused);
void view_remove_light(view_state *state, int unused);
void view_change_kind(view_state *state, int step);

/* Makes a light another of that kind, at the same place. */
void view_make_kind(view_state *state, int index, int kind);

/* Mutes the selected light, or not; in the other function, all the others. Muted lights are kept,
 * but neither light nor are drawn. */
void view_mute_light(view_state *state, int unused);
void view_solo_light(view_state *state, int unused);

/* Aims a spot light at the point under the pointer, or lets a distant light come from there. */
void view_direct_light(view_state *state, int unused);

void view_frame_light(view_state *state, int unused);

#endif
