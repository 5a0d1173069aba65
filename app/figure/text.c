/* SPDX-License-Identifier: MIT */
#include "app/figure/figure.h"

#include <string.h>

#define GLYPH_WIDTH  5
#define GLYPH_HEIGHT 7

/* Rows from the top, the leftmost pixel in bit 4. */
typedef struct glyph {
    char character;
    unsigned char rows[GLYPH_HEIGHT];
} glyph;

static const glyph glyphs[] = {
    { '0', { 0x0E, 0x11, 0x13, 0x15, 0x19, 0x11, 0x0E } },
    { '1', { 0x04, 0x0C, 0x04, 0x04, 0x04, 0x04, 0x0E } },
    { '2', { 0x0E, 0x11, 0x01, 0x02, 0x04, 0x08, 0x1F } },
    { '3', { 0x1F, 0x02, 0x04, 0x02, 0x01, 0x11, 0x0E } },
    { '4', { 0x02, 0x06, 0x0A, 0x12, 0x1F, 0x02, 0x02 } },
    { '5', { 0x1F, 0x10, 0x1E, 0x01, 0x01, 0x11, 0x0E } },
    { '6', { 0x06, 0x08, 0x10, 0x1E, 0x11, 0x11, 0x0E } },
    { '7', { 0x1F, 0x01, 0x02, 0x04, 0x08, 0x08, 0x08 } },
    { '8', { 0x0E, 0x11, 0x11, 0x0E, 0x11, 0x11, 0x0E } },
    { '9', { 0x0E, 0x11, 0x11, 0x0F, 0x01, 0x02, 0x0C } },
    { '+', { 0x00, 0x04, 0x04, 0x1F, 0x04, 0x04, 0x00 } },
    { '-', { 0x00, 0x00, 0x00, 0x1F, 0x00, 0x00, 0x00 } },
    { '=', { 0x00, 0x00, 0x1F, 0x00, 0x1F, 0x00, 0x00 } },
    { 'l', { 0x0C, 0x04, 0x04, 0x04, 0x04, 0x04, 0x0E } },
    { 'm', { 0x00, 0x00, 0x1A, 0x15, 0x15, 0x15, 0x15 } },
};

static const unsigned char *rows_of(char character) {
    static const unsigned char blank[GLYPH_HEIGHT] = { 0 };
    for (size_t i = 0; i < sizeof glyphs / sizeof glyphs[0]; i++)
        if (glyphs[i].character == character)
            return glyphs[i].rows;
    return blank;
}

void figure_text(image *pixels, figure_box box, int height, lmp_rgb color, const char *text) {
    const int dot = height / GLYPH_HEIGHT > 1 ? height / GLYPH_HEIGHT : 1;
    const int width = ((int)strlen(text) * (GLYPH_WIDTH + 1) - 1) * dot;
    int left = box.x + (box.width - width) / 2;
    const int top = box.y + (box.height - GLYPH_HEIGHT * dot) / 2;
    for (; *text; text++, left += (GLYPH_WIDTH + 1) * dot) {
        const unsigned char *const rows = rows_of(*text);
        for (int y = 0; y < GLYPH_HEIGHT; y++)
            for (int x = 0; x < GLYPH_WIDTH; x++)
                if (rows[y] >> (GLYPH_WIDTH - 1 - x) & 1)
                    figure_fill(pixels, (figure_box) { left + x * dot, top + y * dot, dot, dot },
                                color);
    }
}
