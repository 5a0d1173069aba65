/* SPDX-License-Identifier: MIT */
/* shared.h - what later samples of a pixel take of the first one. Where the image is even around a
 * pixel, what its maps show is even too, for they are filtered over it: samples that meet the same
 * surface there need not be asked what it is made of. */
#ifndef LAMPION_CPU_SHARED_H
#define LAMPION_CPU_SHARED_H

#include "app/render/frame/surfaces.h"

/* Keeps the unit normal, without its map, of a pixel of the first sample: surfaces->smooth, which
 * is 0 elsewhere. */
void cpu_shared_keep(const render_surfaces *surfaces, size_t at, lmp_vec3 smooth);

/* Marks the pixels of a rectangle that differ from a neighbor in it. rgba: what the first sample
 * came to. */
void cpu_shared_mark(const render_surfaces *first, const float *rgba,
                     const render_rectangle *pixels);

/* The first sample, for one after it. */
typedef struct cpu_first {
    const render_surfaces *surfaces;
    render_nearness near; /* of the later one's camera */
} cpu_first;

/* Fills value `at` of the planes as the first sample has it, if that saw material `number` near the
 * position, with nearly the same normal, on a pixel that is like its neighbors. */
bool cpu_shared_take(const cpu_first *first, uint32_t number, lmp_vec3 position, lmp_vec3 smooth,
                     size_t at, const render_surfaces *surfaces);

#endif
