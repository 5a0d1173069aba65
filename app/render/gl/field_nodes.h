/* SPDX-License-Identifier: MIT */
/* field_nodes.h - computation of a field's nodes on the device. */
#ifndef LAMPION_RENDER_GL_FIELD_NODES_H
#define LAMPION_RENDER_GL_FIELD_NODES_H

#include "app/render/gl/field_level.h"

enum { GPU_FIELD_LEVELS = 8 };

/* Computes a field's nodes from the lights, beginning with the coarsest field, and uploads the
 * lists of all levels; *program is the compiled pass, or 0 before its first use. */
bool gpu_compute_nodes(GLuint *program, gpu_field_level levels[GPU_FIELD_LEVELS],
                       const gpu_context *context, const gpu_lights *lights, const lmp_field *field,
                       base_error *error);

#endif
