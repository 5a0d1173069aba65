/* SPDX-License-Identifier: MIT */
/* aim.h - light where one looks (docs/aiming.md): while the pointer is dragged over a surface, the
 * selected light goes to where it lights that point as wished. */
#ifndef LAMPION_VIEW_AIM_H
#define LAMPION_VIEW_AIM_H

#include "app/view/state.h"

extern const char *const view_aim_names[VIEW_AIMS + 1]; /* NULL-terminated */

/* Chooses what dragging does; the one chosen already is switched off. */
void view_choose_aim(view_state *state, int aim);

/* Begins a drag of the selected light. Returns false if there is none, nothing is chosen, or the
 * pointer is on no surface. */
bool view_aim_begin(view_state *state);

/* Follows the pointer, as long as it is on a surface. */
void view_aim_follow(view_state *state);

/* Returns the unit direction from a point to the light. `normal` is that of the surface, `view`
 * leads to the eye; both are unit. */
lmp_vec3 view_aim_direction(view_aim aim, lmp_vec3 normal, lmp_vec3 view);

/* Puts a light at a distance from a point, in a unit direction. Spots and areas turn to the point
 * by the smallest rotation, tubes across it; lights without a position come from the direction. */
void view_aim_light(lmp_light *light, lmp_vec3 point, lmp_vec3 direction, float distance);

#endif
