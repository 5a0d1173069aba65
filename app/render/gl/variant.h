/* SPDX-License-Identifier: MIT */
/* variant.h - the shading pass of a frame: compiled on first use for its method, bands, window and
 * tables. */
#ifndef LAMPION_RENDER_GL_VARIANT_H
#define LAMPION_RENDER_GL_VARIANT_H

#include "app/render/gl/environment.h"
#include "app/render/gl/mesh.h"
#include "app/render/method.h"

enum { GPU_VARIANTS = 64 };

/* A compiled shading pass. */
typedef struct gpu_variant {
    method_kind method;
    int bands;
    lmp_window window;
    int tables;               /* summed by bands: 0 none, 1 mirror-symmetric ones, 2 any */
    bool preintegrated_brdfs; /* whether any table is read preintegrated */
    int environment_bands;    /* bands of the environment that tables reflect; 0: none */
    bool sheen;               /* whether another pass has drawn sheen */
    bool areas;               /* whether some lights are areas */
    GLuint program;
} gpu_variant;

/* The variants compiled so far. */
typedef struct gpu_variants {
    gpu_variant items[GPU_VARIANTS];
    int count;
} gpu_variants;

/* Returns the program that shades a frame with a scene's materials, or 0 on failure. */
GLuint gpu_variant_find(gpu_variants *variants, const gpu_context *context, const gpu_mesh *mesh,
                        const render_materials *materials, const gpu_environment *around,
                        const render_frame *frame, base_error *error);
void gpu_variants_delete(gpu_variants *variants);

#endif
