/* SPDX-License-Identifier: MIT */
/* zonal.h - the table of Z_l where a shader reads it. */
#ifndef LAMPION_RENDER_GL_ZONAL_H
#define LAMPION_RENDER_GL_ZONAL_H

#include "app/base/error.h"

#include <epoxy/gl.h>

/* The uploaded table; all 0: none. */
typedef struct gpu_zonal {
    GLuint texture;
    int bands;
} gpu_zonal;

/* Binds the table of so many bands, made on its first use. */
bool gpu_zonal_bind(gpu_zonal *uploaded, int bands, base_error *error);
void gpu_zonal_free(gpu_zonal *uploaded);

#endif
