/* SPDX-License-Identifier: MIT */
#include "app/image/figure.h"

static int clamp(int x, int most) {
    return x < 0 ? 0 : x > most ? most : x;
}

void figure_fill(image *pixels, figure_box box, lmp_rgb color) {
    const int left = clamp(box.x, pixels->width), right = clamp(box.x + box.width, pixels->width);
    const int top = clamp(box.y, pixels->height);
    const int bottom = clamp(box.y + box.height, pixels->height);
    for (int y = top; y < bottom; y++)
        for (int x = left; x < right; x++) {
            float *const rgb = pixels->rgb + 3 * ((size_t)y * (size_t)pixels->width + (size_t)x);
            rgb[0] = color.r;
            rgb[1] = color.g;
            rgb[2] = color.b;
        }
}
