/* SPDX-License-Identifier: MIT */
/* sheen.h - the pass before shading that draws the sheen of materials. */
#ifndef LAMPION_RENDER_GL_SHEEN_H
#define LAMPION_RENDER_GL_SHEEN_H

#include "app/render/gl/environment.h"

/* The uploaded tables of sheen, and the program that reads them; all 0: none. */
typedef struct gpu_sheen {
    gpu_texels tables;
    GLuint program;               /* or 0 */
    int bands, environment_bands; /* for which the program was made */
    bool by_field;
} gpu_sheen;

/* Whether the GPU draws the sheen of materials in the frame. */
bool gpu_sheen_shade(const render_materials *materials, const render_frame *frame);

/* Uploads the tables once and compiles the pass on its first use, if gpu_sheen_shade. */
bool gpu_sheen_prepare(gpu_sheen *own, const gpu_context *context,
                       const render_materials *materials, const gpu_environment *around,
                       const render_frame *frame, base_error *error);

/* Frees the tables, which are then uploaded again when needed. */
void gpu_sheen_forget(gpu_sheen *own);
void gpu_sheen_free(gpu_sheen *own);

#endif
