/* SPDX-License-Identifier: MIT */
/* shared.h - what later samples of a pixel reuse of the first one. Where the image is even around a
 * pixel, what its textures show is even too, because they are filtered: samples that meet the same
 * surface there need not evaluate its material. */
#ifndef LAMPION_RENDER_CPU_SHARED_H
#define LAMPION_RENDER_CPU_SHARED_H

#include "app/render/surfaces.h"

/* Stores the unit normal of a pixel of the first sample, without its normal map, in
 * surfaces->smooth, which is 0 elsewhere. */
void cpu_shared_keep(const render_surfaces *surfaces, size_t at, lmp_vec3 smooth);

/* Marks the pixels of a rectangle that differ from a neighbor in it. rgba: radiance of the first
 * sample. */
void cpu_shared_mark(const render_surfaces *first, const float *rgba,
                     const render_rectangle *pixels);

/* The first sample, as later samples use it. */
typedef struct cpu_first {
    const render_surfaces *surfaces;
    render_nearness near; /* for the later sample's camera */
} cpu_first;

/* Copies value `at` of the planes from the first sample, or marks it as the same, if that sample
 * saw material `number` near the position, with nearly the same normal, on a pixel that is like its
 * neighbors. Returns whether it did. */
bool cpu_shared_take(const cpu_first *first, uint32_t number, lmp_vec3 position, lmp_vec3 smooth,
                     size_t at, const render_surfaces *surfaces);

#endif
