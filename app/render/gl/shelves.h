/* SPDX-License-Identifier: MIT */
/* shelves.h - packing of rectangles into a texture, from left to right on shelves, from the top. */
#ifndef LAMPION_RENDER_GL_SHELVES_H
#define LAMPION_RENDER_GL_SHELVES_H

typedef struct gpu_corner {
    int x, y;
} gpu_corner;

/* The state of packing: zero-initialize all but the width, that of the texture; bottom is the
 * height in use. */
typedef struct gpu_shelves {
    int width, x, top, bottom;
} gpu_shelves;

/* Returns the position of the next rectangle's upper left corner; columns <= width. */
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
