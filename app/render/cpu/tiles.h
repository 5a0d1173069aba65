/* SPDX-License-Identifier: MIT */
/* tiles.h - drawing an image tile by tile: all samples of a tile, or those between two samples that
 * a pass looks at, so that the planes of a sample stay in a core's cache. */
#ifndef LAMPION_RENDER_CPU_TILES_H
#define LAMPION_RENDER_CPU_TILES_H

#include "app/render/cpu/drawing.h"

/* Buffers kept for all tiles, tile after tile, between two samples that a pass looks at, and
 * between finding and shading surfaces; or nothing. */
typedef struct cpu_tiles {
    int count;
    size_t planes;      /* values of a tile's first sample; 0: there are no later samples */
    float *first;       /* planes of the first sample */
    uint32_t *smooth;   /* normals kept for the first sample */
    float *bounced;     /* bounced light of the first sample, or NULL */
    float *first_rgba;  /* radiance of the first sample */
    float *held, *rgba; /* of the sample looked at: seen, emission and weights; radiance */
    float *sums;        /* weighted radiances so far, and weights */
    trace_hit *hits;    /* what the only sample sees, for a field */
    int hit_count;      /* of tiles */
} cpu_tiles;

void cpu_tiles_free(cpu_tiles *tiles);

/* Draws all samples; of the frame's passes only those that work by tiles are run. */
bool cpu_tiles_draw(cpu_tiles *tiles, const cpu_drawing *drawing, render_times *times,
                    base_error *error);

#endif
