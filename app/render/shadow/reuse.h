/* SPDX-License-Identifier: MIT */
/* reuse.h - shadows from one sample of a pixel, reused for another less than a pixel away. */
#ifndef LAMPION_RENDER_SHADOW_REUSE_H
#define LAMPION_RENDER_SHADOW_REUSE_H

#include "app/render/shadow/planes.h"
#include "app/render/surfaces.h"

/* Multiplies radiance by the filtered ratio of pixels on the same surface, for `count` pixels of a
 * row of the image from x on, which lie in the tile from `at` on. */
void shadow_reuse_row(const shadow_planes *planes, const render_tile *tile, size_t at, int x, int y,
                      int count, float *rgba);

#endif
