/* SPDX-License-Identifier: MIT */
/* figure.h - drawings for documents, in linear color on an image: boxes, a few words, lobes. */
#ifndef LAMPION_FIGURE_H
#define LAMPION_FIGURE_H

#include "app/image/image.h"

#include <lampion/base.h>

/* A rectangle of pixels; what lies outside of the image is not drawn. */
typedef struct figure_box {
    int x, y, width, height;
} figure_box;

void figure_fill(image *pixels, figure_box box, lmp_rgb color);

/* Writes letters, all small, digits and signs, `height` pixels high, centered in the box; what it
 * does not know is a blank. */
#define FIGURE_LETTER_WIDTH  6 /* of letters FIGURE_LETTER_HEIGHT high, with the gap after them */
#define FIGURE_LETTER_HEIGHT 7
void figure_text(image *pixels, figure_box box, int height, lmp_rgb color, const char *text);

/* A function on the sphere as a surface: |radius(direction)| away from the center. */
typedef struct figure_lobe {
    float (*radius)(lmp_vec3 direction, const void *user); /* at most 1 in magnitude */
    const void *user;
    lmp_rgb positive, negative; /* colors by the sign of the radius */
} figure_lobe;

/* Draws the lobe into the box, z up, seen a little from above. */
bool figure_draw_lobe(image *pixels, figure_box box, const figure_lobe *lobe, cli_error *error);

#endif
