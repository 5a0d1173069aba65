/* SPDX-License-Identifier: MIT */
#include "app/trace/texture.h"

#include "app/image/srgb.h"

#include <math.h>

static uint32_t wrap(double texel, uint32_t size, uint32_t mode) {
    const double n = size;
    double i = floor(texel);
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

static void add_texel(const scene *world, const scene_texture *texture, double x, double y,
                      double weight, double rgba[4]) {
    const uint32_t column = wrap(x, texture->width, texture->wrap_u);
    const uint32_t row = wrap(y, texture->height, texture->wrap_v);
    const unsigned char *texel =
        world->texels + texture->first_byte + 4 * ((size_t)row * texture->width + column);
    for (int c = 0; c < 4; c++) {
        const double v = texel[c] / 255.0;
        rgba[c] += weight * (texture->srgb && c < 3 ? image_srgb_to_linear(v) : v);
    }
}

void trace_texture_at(const scene *world, const scene_texture_use *use, const double uv[2],
                      double rgba[4]) {
    for (int c = 0; c < 4; c++)
        rgba[c] = use->texture < 0;
    if (use->texture < 0)
        return;
    const scene_texture *texture = &world->textures[use->texture];
    double texel[2], fraction[2];
    for (int i = 0; i < 2; i++) {
        const double at = (double)use->matrix[2 * i] * uv[0] +
                          (double)use->matrix[2 * i + 1] * uv[1] + (double)use->offset[i];
        const double scaled = at * (i == 0 ? texture->width : texture->height) - 0.5;
        texel[i] = floor(scaled);
        fraction[i] = scaled - texel[i];
    }
    for (int j = 0; j < 2; j++)
        for (int i = 0; i < 2; i++)
            add_texel(world, texture, texel[0] + i, texel[1] + j,
                      (i ? fraction[0] : 1 - fraction[0]) * (j ? fraction[1] : 1 - fraction[1]),
                      rgba);
}
