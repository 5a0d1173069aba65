/* SPDX-License-Identifier: MIT */
/* program.h - compilation and linking of shaders. */
#ifndef LAMPION_RENDER_GL_PROGRAM_H
#define LAMPION_RENDER_GL_PROGRAM_H

#include "app/base/error.h"

#include <epoxy/gl.h>

typedef struct gpu_stage {
    GLenum type;
    const char *file;
} gpu_stage;

/* Compiles and links; `defines` is text inserted at the start of every stage. Returns 0 on
 * failure. */
GLuint gpu_program(const gpu_stage *stages, int count, const char *defines, base_error *error);

#endif
