/* SPDX-License-Identifier: MIT */
/* field.h - a field where shaders read it. */
#ifndef LAMPION_RENDER_GL_FIELD_H
#define LAMPION_RENDER_GL_FIELD_H

#include "app/render/gl/field_nodes.h"

/* The uploaded field, and the pass that computes nodes; all 0: nothing. */
typedef struct gpu_field {
    gpu_field_level levels[GPU_FIELD_LEVELS]; /* the field, then coarser ones */
    GLuint staging, program;                  /* a buffer or 0; field_nodes.comp or 0 */
    uint64_t stamp;                           /* of the field in the buffers */
} gpu_field;

/* Binds the frame's field, computed or uploaded if it has changed; *milliseconds, if not NULL,
 * receives the time that took. */
bool gpu_field_bind(gpu_field *own, const gpu_context *context, const gpu_lights *lights,
                    const render_frame *frame, double *milliseconds, base_error *error);
void gpu_field_free(gpu_field *own);

#endif
