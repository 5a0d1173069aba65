/* SPDX-License-Identifier: MIT */
/* ball.h - what a material looks like: a ball of it under a soft box and a sky. */
#ifndef LAMPION_VIEW_BALL_H
#define LAMPION_VIEW_BALL_H

#include "app/view/settings.h"

enum { VIEW_BALL_SIZE = 48 }; /* pixels across */

typedef struct view_ball {
    char material[VIEW_MATERIAL_SIZE];              /* the one drawn last */
    bool drawn;                                     /* whether it could be */
    float rgb[3 * VIEW_BALL_SIZE * VIEW_BALL_SIZE]; /* 0 … 1, linear; below 0 beside the ball */
} view_ball;

/* Draws a material by its name, unless it is there already. Returns false where it cannot be drawn:
 * tables have no values for single directions. */
bool view_ball_draw(view_ball *ball, const char *material);

#endif
