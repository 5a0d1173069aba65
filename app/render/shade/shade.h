/* SPDX-License-Identifier: MIT */
/* shade.h - surfaces lit by the library, on all cores. */
#ifndef LAMPION_SHADE_FRAME_H
#define LAMPION_SHADE_FRAME_H

#include "app/render/frame/surfaces.h"

/* A render_shader: by the frame's method, bands, window, lights and lobes. */
bool shade_frame(const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                 cli_error *error);

/* --- a tile at a time ------------------------------------------------------------------------- */

/* What the pixels of a frame are shaded by. */
typedef struct shade_job shade_job;

/* Follows the frame's lights; `surfaces` is what its field, if any, is computed for, and else NULL.
 * NULL without memory. */
shade_job *shade_begin(const render_frame *frame, const render_surfaces *surfaces);
void shade_end(shade_job *job);

/* An earlier sample of the same pixels, and what it came to. A later one that sees the same surface
 * nearby takes its radiance: how a surface is lit changes less within a pixel than what is seen at
 * the edges of surfaces does. */
typedef struct shade_sample {
    const render_surfaces *surfaces;
    const float *rgba; /* of the planes' pixels */
} shade_sample;

/* Shades a rectangle of at most RENDER_TILE pixels a side, from any thread with a tile of its own
 * for RENDER_TILE_PIXELS. rgba: of the pixels of the surfaces' planes; before: NULL, or planes of
 * the same rectangle. */
void shade_tile(const shade_job *job, const render_surfaces *surfaces, const shade_sample *before,
                const render_rectangle *pixels, render_tile *tile, float *rgba);

/* All of a frame's tiles. */
bool shade_tiles(const shade_job *job, const render_surfaces *surfaces, const shade_sample *before,
                 float *rgba);

#endif
