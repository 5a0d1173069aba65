/* SPDX-License-Identifier: MIT */
/* drawing.h - the state of drawing a frame. */
#ifndef LAMPION_RENDER_CPU_DRAWING_H
#define LAMPION_RENDER_CPU_DRAWING_H

#include "app/render/cpu/rays.h"
#include "app/scene/vector.h"

typedef struct cpu_drawing {
    const render_frame *frame;
    const render_materials *materials;
    const environment *environment;
    cpu_view view;
    int samples;    /* the image is the mean of so many samples, when all are drawn */
    float exposure; /* by which bright samples are weighted down */
    image *image;
} cpu_drawing;

static inline void cpu_set_planes(const cpu_drawing *d, const render_camera *camera,
                                  render_surfaces *s) {
    s->camera = *camera;
    s->frame = d->frame;
    s->materials = d->materials;
    s->environment = d->environment;
}

/* Returns the blend weight of a sample that met a blended surface, or 0. */
static inline float cpu_blended(const render_surfaces *s, size_t pixel) {
    return s->weight ? s->weight[pixel] : 0;
}

/* Multiplies a sample by its weight and appends the weight. Bright samples weigh less, as the tone
 * curve will compress them: the edge of a lamp then fades over a pixel instead of staying jagged
 * (shaders/program/resolve.comp does the same). Where `blended` is above 0, it is the weight
 * instead, which mixes blended surfaces exactly. */
static inline void cpu_weigh_sample(float exposure, const float *rgba, float blended,
                                    float weighed[4]) {
    weighed[3] = blended > 0 ? blended : 1 / (1 + exposure * rgb_brightest(rgba));
    for (int c = 0; c < 3; c++)
        weighed[c] = rgba[c] * weighed[3];
}

static inline void cpu_add_sample(float exposure, const float *rgba, float blended, float sum[4]) {
    float weighed[4];
    cpu_weigh_sample(exposure, rgba, blended, weighed);
    for (int c = 0; c < 4; c++)
        sum[c] += weighed[c];
}

/* Sets a pixel of the image to its only sample, or to the mean of all. */
static inline void cpu_set_pixel(int samples, const float *rgba, const float sum[4], float *rgb) {
    for (int c = 0; c < 3; c++)
        rgb[c] = samples > 1 ? sum[c] / sum[3] : rgba[c];
}

#endif
