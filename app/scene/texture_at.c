/* SPDX-License-Identifier: MIT */
#include "app/scene/texture_at.h"

#include "app/image/srgb.h"

#include <math.h>

/* Wraps a whole texel coordinate, however large, into the texture. */
static uint32_t wrap(double texel, uint32_t size, uint32_t mode) {
    const double n = size;
    double i = texel;
    if (i >= 0 && i < n)
        return (uint32_t)i;
    if (mode == SCENE_WRAP_CLAMP)
        i = fmin(fmax(i, 0), n - 1);
    else if (mode == SCENE_WRAP_REPEAT)
        i -= n * floor(i / n);
    else {
        i -= 2 * n * floor(i / (2 * n));
        i = i < n ? i : 2 * n - 1 - i;
    }
    return i > 0 && i < n ? (uint32_t)i : 0;
}

/* The four texels around a point, and their weights. */
typedef struct corner_texels {
    const unsigned char *rgba[4];
    double weights[4];
} corner_texels;

static corner_texels find_texels(const scene *world, const scene_texture_use *use,
                                 const double uv[2]) {
    const scene_texture *texture = &world->textures[use->texture];
    const uint32_t size[2] = { texture->width, texture->height };
    const uint32_t modes[2] = { texture->wrap_u, texture->wrap_v };
    double part[2][2];
    uint32_t texels[2][2];
    for (int i = 0; i < 2; i++) {
        const double at = (double)use->matrix[2 * i] * uv[0] +
                          (double)use->matrix[2 * i + 1] * uv[1] + (double)use->offset[i];
        const double scaled = at * size[i] - 0.5, first = floor(scaled);
        part[i][1] = scaled - first;
        part[i][0] = 1 - part[i][1];
        texels[i][0] = wrap(first, size[i], modes[i]);
        texels[i][1] = wrap(first + 1, size[i], modes[i]);
    }
    corner_texels found;
    for (int k = 0; k < 4; k++) {
        const int i = k % 2, j = k / 2;
        found.rgba[k] = world->texels + texture->first_byte +
                        4 * ((size_t)texels[1][j] * size[0] + texels[0][i]);
        found.weights[k] = part[0][i] * part[1][j];
    }
    return found;
}

void texture_at(const scene *world, const scene_texture_use *use, const double uv[2],
                double rgba[4]) {
    for (int c = 0; c < 4; c++)
        rgba[c] = use->texture < 0;
    if (use->texture < 0)
        return;
    const bool srgb = world->textures[use->texture].srgb;
    const corner_texels found = find_texels(world, use, uv);
    for (int k = 0; k < 4; k++)
        for (int c = 0; c < 4; c++) {
            const double v = found.rgba[k][c] / 255.0;
            rgba[c] += found.weights[k] * (srgb && c < 3 ? image_srgb_to_linear(v) : v);
        }
}

double texture_alpha_at(const scene *world, const scene_texture_use *use, const double uv[2]) {
    if (use->texture < 0)
        return 1;
    const corner_texels found = find_texels(world, use, uv);
    double alpha = 0;
    for (int k = 0; k < 4; k++)
        alpha += found.weights[k] * (found.rgba[k][3] / 255.0);
    return alpha;
}
