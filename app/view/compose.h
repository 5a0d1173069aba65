/* SPDX-License-Identifier: MIT */
/* compose.h - one image, two side by side, or their difference (shaders/program/compose.frag does
 * the same in a window). */
#ifndef LAMPION_VIEW_COMPOSE_H
#define LAMPION_VIEW_COMPOSE_H

#include "app/render/gl/gpu.h"

typedef struct view_side {
    int width, height;
    unsigned char *rgb8; /* rows from the top */
} view_side;

/* Composes the sides into rgb8, which has the layout's size, as the sides have. */
void view_compose(const view_side sides[2], const gpu_layout *layout, unsigned char *rgb8);

#endif
