/* SPDX-License-Identifier: MIT */
/* texels.h - arrays of vec4 that shaders read at any index (shaders/program/texels.glsl).
 *
 * Hardware reads them from storage blocks. Software fetches them from buffer textures: llvmpipe
 * writes out each load from a block as a loop over the threads, and takes several times as long to
 * compile it. */
#ifndef LAMPION_RENDER_GL_TEXELS_H
#define LAMPION_RENDER_GL_TEXELS_H

#include "app/render/gl/gpu.h"

#include <epoxy/gl.h>

/* An array in both forms; all 0: none. */
typedef struct gpu_texels {
    GLuint buffer, texture;
} gpu_texels;

/* Replaces an array by one of so many bytes; bytes may be NULL: they are written later. */
void gpu_texels_create(gpu_texels *own, size_t size, const void *bytes);

/* Binds an array for the shaders that declare it by this number. */
void gpu_texels_bind(const gpu_texels *own, GLuint number);
void gpu_texels_free(gpu_texels *own);

/* Returns what shaders define to read arrays as is best for the device. */
const char *gpu_texels_define(const gpu_context *context);

#endif
