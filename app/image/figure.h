/* SPDX-License-Identifier: MIT */
/* figure.h - drawings for documents, in linear color on an image: boxes, short texts, lobes. */
#ifndef LAMPION_IMAGE_FIGURE_H
#define LAMPION_IMAGE_FIGURE_H

#include "app/image/image.h"

#include <lampion/base.h>

/* A rectangle of pixels; parts outside the image are not drawn. */
typedef struct figure_box {
    int x, y, width, height;
} figure_box;

void figure_fill(image *pixels, figure_box box, lmp_rgb color);

/* Writes letters, in lower case, digits and signs, `height` pixels high, centered in the box;
 * unknown characters are blank. */
#define FIGURE_LETTER_WIDTH  6 /* at FIGURE_LETTER_HEIGHT, with the gap */
#define FIGURE_LETTER_HEIGHT 7
void figure_text(image *pixels, figure_box box, int height, lmp_rgb color, const char *text);

/* A function on the sphere drawn as a surface, |radius(direction)| away from the center. */
typedef struct figure_lobe {
    float (*radius)(lmp_vec3 direction, const void *user); /* at most 1 in magnitude */
    const void *user;
    lmp_rgb positive, negative; /* colors by the sign of the radius */
} figure_lobe;

/* Draws the lobe into the box, z up, seen from slightly above. */
bool figure_draw_lobe(image *pixels, figure_box box, const figure_lobe *lobe, base_error *error);

#endif
