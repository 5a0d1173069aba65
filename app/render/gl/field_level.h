/* SPDX-License-Identifier: MIT */
/* field_level.h - the buffers of a field, or of a coarser level of it, as shaders read them. */
#ifndef LAMPION_RENDER_GL_FIELD_LEVEL_H
#define LAMPION_RENDER_GL_FIELD_LEVEL_H

#include "app/render/gl/gpu.h"
#include "app/render/gl/light_buffer.h"
#include "app/render/gl/texels.h"

/* A field or, where shaders compute its nodes, a coarser level of it: buffers of its nodes and of
 * its lists of near lights. */
typedef struct gpu_field_level {
    gpu_texels nodes;
    GLuint block;
    size_t bytes;   /* of the nodes */
    size_t longest; /* most lights near a cell */
} gpu_field_level;

/* Returns the bytes of a field's nodes as shaders read them; gpu_reserve_nodes allocates them. */
size_t gpu_node_bytes(const lmp_field_desc *desc);
void gpu_reserve_nodes(gpu_field_level *level, size_t bytes);

/* Uploads all of a field except its nodes. */
bool gpu_upload_field(const gpu_context *context, const gpu_lights *lights, const lmp_field *field,
                      gpu_field_level *level);

#endif
