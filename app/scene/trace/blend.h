/* SPDX-License-Identifier: MIT */
/* blend.h - which of the surfaces along a ray that blend by alpha a sample of a pixel sees.
 *
 * The samples of a pixel divide at each surface: at least one sees it, and at least one sees what
 * is behind. Weights make up for their numbers, so that the mean is exactly that of alpha blending,
 * without noise, as long as there are enough samples; a single remaining sample decides at
 * random. */
#ifndef LAMPION_SCENE_TRACE_BLEND_H
#define LAMPION_SCENE_TRACE_BLEND_H

#include <stdbool.h>
#include <stdint.h>

/* The state of one sample: its rank among the samples of the pixel that reach this depth, and their
 * count. */
typedef struct blend_part {
    uint32_t rank, count;
    float dice;   /* uniform in 0 … 1, per pixel */
    float weight; /* of what it sees; the mean over all samples is 1 */
    bool blended; /* whether it met a blended surface */
} blend_part;

/* Returns the initial state of sample `sample` of `samples` of the pixel at x, y; neighboring
 * pixels begin with other ranks. */
blend_part blend_begin(uint32_t x, uint32_t y, uint32_t sample, uint32_t samples);

/* Whether the sample sees the next surface rather than what is behind it. */
bool blend_sees(blend_part *part, float alpha);

#endif
