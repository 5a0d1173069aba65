/* SPDX-License-Identifier: MIT */
/* split.h - which lights a pixel's radiance comes from. */
#ifndef LAMPION_RENDER_CPU_SPLIT_H
#define LAMPION_RENDER_CPU_SPLIT_H

#include "app/render/cpu/drawing.h"

/* A pixel's radiance, split by what it comes from. */
typedef struct cpu_split {
    uint32_t seen;   /* as in render_surfaces; all else is 0 unless it is a surface, of which: */
    lmp_rgb *lights; /* the reflected light of each light; the caller's, 0 at first */
    lmp_rgb environment, emission, bounced;
} cpu_split;

/* Splits a pixel of a drawing, as cpu_split_pixel says. */
bool cpu_split_draw(const cpu_drawing *drawing, int x, int y, const render_pass *around,
                    cpu_split *split, base_error *error);

#endif
