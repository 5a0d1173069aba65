/* SPDX-License-Identifier: MIT */
/* preintegrated_brdf.h - preintegrated BRDFs where shaders read them. */
#ifndef LAMPION_RENDER_GL_PREINTEGRATED_BRDF_H
#define LAMPION_RENDER_GL_PREINTEGRATED_BRDF_H

#include "app/render/materials.h"

#include <epoxy/gl.h>

/* The uploaded BRDFs; all 0: none. */
typedef struct gpu_preintegrated_brdfs {
    GLuint texels, block; /* texture, buffer */
} gpu_preintegrated_brdfs;

/* Whether any material has a preintegrated BRDF. */
bool gpu_preintegrated_brdfs_exist(const render_materials *materials);

/* Binds the materials' preintegrated BRDFs, uploaded once. */
bool gpu_preintegrated_brdfs_bind(gpu_preintegrated_brdfs *uploaded,
                                  const render_materials *materials, base_error *error);

/* Frees the uploaded BRDFs, which are then uploaded again when needed. */
void gpu_preintegrated_brdfs_free(gpu_preintegrated_brdfs *uploaded);

#endif
