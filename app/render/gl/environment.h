/* SPDX-License-Identifier: MIT */
/* environment.h - the environment where shaders read it. */
#ifndef LAMPION_RENDER_GL_ENVIRONMENT_H
#define LAMPION_RENDER_GL_ENVIRONMENT_H

#include "app/render/frame.h"
#include "app/render/gl/texels.h"
#include "app/render/materials.h"
#include "app/scene/environment.h"

#include <epoxy/gl.h>

/* An environment and its uploaded data; all 0: none. */
typedef struct gpu_environment {
    const environment *source; /* or NULL; not owned */
    GLuint backdrop;           /* a texture, or 0 */
    gpu_texels coefficients;
    int bands; /* for which the coefficients were uploaded */
    lmp_window window;
} gpu_environment;

/* Replaces the environment; NULL: none. */
void gpu_environment_set(gpu_environment *own, const environment *source);

/* Uploads what the shaders of a frame read, once per number of bands and window, and binds it. */
bool gpu_environment_bind(gpu_environment *own, const render_materials *materials,
                          const render_frame *frame, base_error *error);

/* Returns how many of the environment's bands tables reflect in a frame of so many bands. */
int gpu_environment_reflected(const gpu_environment *own, int bands);

/* Fills the frame block's member. */
void gpu_environment_describe(const gpu_environment *own, const render_frame *frame,
                              float surroundings[4]);

#endif
