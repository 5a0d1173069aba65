/* SPDX-License-Identifier: MIT */
#include "app/view/compose.h"

#include <stdlib.h>
#include <string.h>

static unsigned char difference(unsigned char a, unsigned char b) {
    const int gained = abs(a - b) * GPU_DIFFERENCE_GAIN;
    return (unsigned char)(gained < 255 ? gained : 255);
}

void view_compose(const view_side sides[2], const gpu_layout *layout, unsigned char *rgb8) {
    const size_t width = (size_t)layout->width, count = width * (size_t)layout->height;
    const unsigned char *first = sides[0].rgb8, *second = sides[1].rgb8;
    if (layout->split == GPU_SPLIT_NONE || !second) {
        memcpy(rgb8, first, 3 * count);
        return;
    }
    for (size_t i = 0; i < 3 * count; i++) {
        const bool right = (float)(i / 3 % width) + 0.5f >= layout->divider * (float)layout->width;
        rgb8[i] = layout->split == GPU_SPLIT_DIFFERENCE ? difference(first[i], second[i])
                  : right                               ? second[i]
                                                        : first[i];
    }
}
