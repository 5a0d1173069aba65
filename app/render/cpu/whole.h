/* SPDX-License-Identifier: MIT */
/* whole.h - drawing sample by sample of the whole image, where a pass needs all surfaces of a
 * sample at once, or samples are requested one at a time. */
#ifndef LAMPION_RENDER_CPU_WHOLE_H
#define LAMPION_RENDER_CPU_WHOLE_H

#include "app/render/cpu/drawing.h"

/* Planes of an image's size, or nothing. */
typedef struct cpu_whole {
    render_surfaces surfaces, first; /* of the current sample, and of the first */
    float *rgba, *first_rgba;        /* their radiance, four values per pixel */
    const render_surfaces *kept;     /* filled for `view`, also behind lights; NULL: none */
    render_camera view;
    float *sums; /* weighted radiances of the samples so far, and weights */
} cpu_whole;

void cpu_whole_free(cpu_whole *planes);

/* Draws samples first to end - 1; if `show`, the image is the mean so far after each, else after
 * the last. */
bool cpu_whole_draw(cpu_whole *planes, const cpu_drawing *drawing, int first, int end, bool show,
                    render_times *times, base_error *error);

#endif
