/* SPDX-License-Identifier: MIT */
/* preintegrated_lobe.h - a preintegrated lobe where shaders read it. */
#ifndef LAMPION_RENDER_GL_PREINTEGRATED_LOBE_H
#define LAMPION_RENDER_GL_PREINTEGRATED_LOBE_H

#include "app/base/error.h"

#include <epoxy/gl.h>
#include <lampion/preintegrated.h>

/* The uploaded lobe; all 0: none. */
typedef struct gpu_preintegrated_lobe {
    GLuint pairs, block;                /* texture, buffer */
    const lmp_preintegrated_lobe *lobe; /* the lobe that was uploaded */
    int bands;
    lmp_window window;
} gpu_preintegrated_lobe;

/* Binds the lobe, uploaded once and whenever another one replaces it. */
bool gpu_preintegrated_lobe_bind(gpu_preintegrated_lobe *uploaded,
                                 const lmp_preintegrated_lobe *lobe, base_error *error);
void gpu_preintegrated_lobe_free(gpu_preintegrated_lobe *uploaded);

#endif
