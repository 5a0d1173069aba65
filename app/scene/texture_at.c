/* SPDX-License-Identifier: MIT */
#include "app/scene/texture_at.h"

#include "app/image/srgb.h"

#include <math.h>

/* The most parts of a triangle's side that are looked at for its mean. */
enum { PARTS_MAX = 64 };

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

/* Returns into how many parts a triangle's sides are divided so that a part is about a texel. */
static int parts_of(const scene *world, const scene_texture_use *use, double (*uv)[2]) {
    const scene_texture *texture = &world->textures[use->texture];
    double longest = 0;
    for (int i = 0; i < 3; i++) {
        const double u = uv[(i + 1) % 3][0] - uv[i][0], v = uv[(i + 1) % 3][1] - uv[i][1];
        const double x = (double)use->matrix[0] * u + (double)use->matrix[1] * v,
                     y = (double)use->matrix[2] * u + (double)use->matrix[3] * v;
        longest = fmax(longest, hypot(x * texture->width, y * texture->height));
    }
    return longest < PARTS_MAX ? (int)longest + 1 : PARTS_MAX;
}

void texture_mean_at(const scene *world, const scene_texture_use *use, double (*uv)[2],
                     double rgba[4]) {
    for (int c = 0; c < 4; c++)
        rgba[c] = use->texture < 0;
    if (use->texture < 0)
        return;
    /* the middles of n² equal triangles: n (n + 1) / 2 lie as the whole does, the others upside
     * down */
    const int n = parts_of(world, use, uv);
    for (int j = 0; j < n; j++)
        for (int i = 0; i < 2 * (n - j) - 1; i++) {
            const double third = i % 2 ? 2.0 / 3 : 1.0 / 3;
            const double a = (i / 2 + third) / n, b = (j + third) / n, c = 1 - a - b;
            const double at[2] = { c * uv[0][0] + a * uv[1][0] + b * uv[2][0],
                                   c * uv[0][1] + a * uv[1][1] + b * uv[2][1] };
            double one[4];
            texture_at(world, use, at, one);
            for (int k = 0; k < 4; k++)
                rgba[k] += one[k] / ((double)n * n);
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
