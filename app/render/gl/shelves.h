/* SPDX-License-Identifier: MIT */
/* shelves.h - rectangles side by side in a texture: from left to right, on shelves from the top. */
#ifndef LAMPION_GPU_SHELVES_H
#define LAMPION_GPU_SHELVES_H

typedef struct gpu_corner {
    int x, y;
} gpu_corner;

/* Zero-initialize but for the width, that of the texture; bottom is then the height in use. */
typedef struct gpu_shelves {
    int width, x, top, bottom;
} gpu_shelves;

/* Where the next rectangle's upper left corner lies; columns <= width. */
static inline gpu_corner gpu_shelves_put(gpu_shelves *shelves, int columns, int rows) {
    if (shelves->x + columns > shelves->width) {
        shelves->x = 0;
        shelves->top = shelves->bottom;
    }
    const gpu_corner corner = { shelves->x, shelves->top };
    shelves->x += columns;
    if (shelves->top + rows > shelves->bottom)
        shelves->bottom = shelves->top + rows;
    return corner;
}

#endif
