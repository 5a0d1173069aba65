/* SPDX-License-Identifier: MIT */
/* compose.h - one image, two beside each other, or how they differ (shaders/compose.frag does the
 * same in a window). */
#ifndef LAMPION_VIEW_COMPOSE_H
#define LAMPION_VIEW_COMPOSE_H

#include "app/render/gl/gpu.h"

typedef struct view_side {
    int width, height;
    unsigned char *rgb8; /* rows from the top */
} view_side;

/* rgb8: of the layout's size, which is that of the sides. */
void view_compose(const view_side sides[2], const gpu_layout *layout, unsigned char *rgb8);

#endif
