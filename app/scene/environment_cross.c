/* SPDX-License-Identifier: MIT */
#include "app/scene/environment.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

/* A face of the cube: the axes along which columns and rows grow, the axis it lies on, and its
 * position in a cross of 4 x 3 and in one of 3 x 4 faces; in the latter the last face is upside
 * down. */
typedef struct face {
    signed char column[3], row[3], on[3];
    signed char wide[2], tall[2];
} face;

static const face faces[6] = {
    { { 1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 }, { 1, 1 }, { 1, 1 } },
    { { 0, 0, 1 }, { 0, -1, 0 }, { 1, 0, 0 }, { 2, 1 }, { 2, 1 } },
    { { 0, 0, -1 }, { 0, -1, 0 }, { -1, 0, 0 }, { 0, 1 }, { 0, 1 } },
    { { 1, 0, 0 }, { 0, 0, -1 }, { 0, 1, 0 }, { 1, 0 }, { 1, 0 } },
    { { 1, 0, 0 }, { 0, 0, 1 }, { 0, -1, 0 }, { 1, 2 }, { 1, 2 } },
    { { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 3, 1 }, { 1, 3 } },
};
enum { BEHIND = 5 };

static double along(const signed char axis[3], const double w[3]) {
    return axis[0] * w[0] + axis[1] * w[1] + axis[2] * w[2];
}

static int index_on(double at, int size) {
    const int index = (int)((at + 1) / 2 * size);
    return index < 0 ? 0 : index < size ? index : size - 1;
}

static const float *pixel_at(const image *cross, const double w[3]) {
    const bool tall = cross->height > cross->width;
    const int size = tall ? cross->width / 3 : cross->width / 4;
    int nearest = 0;
    for (int i = 1; i < 6; i++)
        if (along(faces[i].on, w) > along(faces[nearest].on, w))
            nearest = i;
    const face *f = &faces[nearest];
    const double forward = along(f->on, w);
    int x = index_on(along(f->column, w) / forward, size);
    int y = index_on(along(f->row, w) / forward, size);
    if (tall && nearest == BEHIND) {
        x = size - 1 - x;
        y = size - 1 - y;
    }
    x += size * (tall ? f->tall[0] : f->wide[0]);
    y += size * (tall ? f->tall[1] : f->wide[1]);
    return cross->rgb + 3 * ((size_t)y * (size_t)cross->width + (size_t)x);
}

bool environment_unfold(const image *cross, image *map, base_error *error) {
    const int size = cross->height > cross->width ? cross->width / 3 : cross->width / 4;
    if (!image_create(map, 4 * size, 2 * size, error))
        return false;
    for (int row = 0; row < map->height; row++)
        for (int column = 0; column < map->width; column++) {
            const double polar = pi * (row + 0.5) / map->height;
            const double azimuth = 2 * pi * (column + 0.5) / map->width - pi;
            const double w[3] = { sin(polar) * cos(azimuth), cos(polar),
                                  sin(polar) * sin(azimuth) };
            const float *from = pixel_at(cross, w);
            float *to = map->rgb + 3 * ((size_t)row * (size_t)map->width + (size_t)column);
            for (int c = 0; c < 3; c++)
                to[c] = from[c];
        }
    return true;
}
