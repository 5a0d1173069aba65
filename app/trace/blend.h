/* SPDX-License-Identifier: MIT */
/* blend.h - which samples of a pixel a surface hides that blends by its alpha. */
#ifndef LAMPION_TRACE_BLEND_H
#define LAMPION_TRACE_BLEND_H

#include <stdint.h>

/* The alpha from which on sample `sample` of `samples` shows the surface rather than what is behind
 * it. The samples' thresholds are spread evenly over 0 … 1, and those of different keys, which
 * stand for a pixel and a triangle, have nothing to do with each other. */
float blend_threshold(uint32_t key, uint32_t sample, uint32_t samples);

#endif
