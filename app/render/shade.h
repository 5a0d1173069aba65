/* SPDX-License-Identifier: MIT */
/* shade.h - shading of surfaces by the library, on all cores. */
#ifndef LAMPION_RENDER_SHADE_H
#define LAMPION_RENDER_SHADE_H

#include "app/render/shade_field.h"

/* Shades a frame by its method, bands, window, lights and lobes; a render_shader. */
bool shade_frame(const render_frame *frame, const render_surfaces *surfaces, float *rgba,
                 base_error *error);

/* --- a tile at a time ------------------------------------------------------------------------- */

/* The data that a frame's pixels are shaded with. */
typedef struct shade_job shade_job;

/* Begins shading with the frame's lights; if it has a field, its nodes are computed that `want`
 * requests. Returns NULL if memory ran out or `want` failed. */
shade_job *shade_begin(const render_frame *frame, shade_want *want, void *user);
void shade_end(shade_job *job);

/* Records how long shading the surfaces took, for the statistics of a field. */
void shade_note(const shade_job *job, double milliseconds);

/* An earlier sample of the same pixels, and its radiance. A later sample that sees the same surface
 * at a nearby position takes its radiance: lighting changes less within a pixel than what is seen
 * at the edges of surfaces. */
typedef struct shade_sample {
    const render_surfaces *surfaces;
    const float *rgba; /* of the planes' pixels */
} shade_sample;

/* Shades a rectangle of at most RENDER_TILE pixels a side; may be called from any thread, with a
 * tile of its own for RENDER_TILE_PIXELS. rgba: of the pixels of the surfaces' planes; before:
 * NULL, or planes of the same rectangle. */
void shade_tile(const shade_job *job, const render_surfaces *surfaces, const shade_sample *before,
                const render_rectangle *pixels, render_tile *tile, float *rgba);

/* Shades all of a frame's tiles. */
bool shade_tiles(const shade_job *job, const render_surfaces *surfaces, const shade_sample *before,
                 float *rgba);

#endif
