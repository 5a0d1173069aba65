/* SPDX-License-Identifier: MIT */
/* passes.h - the passes of a sample: the G-buffer, shading, the mean of the samples so far. */
#ifndef LAMPION_RENDER_GL_PASSES_H
#define LAMPION_RENDER_GL_PASSES_H

#include "app/render/gl/state.h"

void gpu_draw_gbuffer(gpu_renderer *renderer, const render_frame *frame, const shared_frame *block);

/* Binds the G-buffer's textures and the blocks for a compute pass. */
void gpu_bind_gbuffer(const gpu_renderer *renderer);

/* Shades one sample of every pixel into the HDR target. */
void gpu_shade(gpu_renderer *renderer, const render_frame *frame, GLuint program);

/* Adds the HDR target to the sums and replaces it by the mean, after the last sample or, if `show`,
 * after every one. */
void gpu_resolve(gpu_renderer *renderer, const render_frame *frame, int index, bool show);

#endif
