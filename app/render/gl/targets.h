/* SPDX-License-Identifier: MIT */
/* targets.h - the textures that a frame is drawn to. */
#ifndef LAMPION_RENDER_GL_TARGETS_H
#define LAMPION_RENDER_GL_TARGETS_H

#include "app/render/gl/gpu.h"
#include "shaders/program/shared.h"

#include <epoxy/gl.h>

/* The number of attachments (shared.h); those that only layered materials have come last. */
enum { GPU_ATTACHMENTS = 8, GPU_ATTACHMENTS_PLAIN = 5 };

/* The targets of a renderer; all 0: none. */
typedef struct gpu_targets {
    int width, height;
    int count;                        /* of the attachments in use, which are the first ones */
    GLuint kept[GPU_ATTACHMENTS + 1]; /* a copy of attachments and depth without lights, or 0 */
    mat4 kept_view;
    GLuint attachments[GPU_ATTACHMENTS], depth, hdr, sums, framebuffer, ldr, ldr_framebuffer;
} gpu_targets;

/* The formats of the G-buffer's attachments, then of its depth. */
extern const GLenum gpu_target_formats[GPU_ATTACHMENTS + 1];
GLuint gpu_target_create(GLenum format, int width, int height);

/* Creates all targets for frames of this size, with or without layered materials, replacing those
 * of another size. Returns true at once if the size is the same. */
bool gpu_targets_create(gpu_targets *targets, const gpu_context *context, bool layered, int width,
                        int height, base_error *error);
void gpu_targets_delete(gpu_targets *targets);

#endif
