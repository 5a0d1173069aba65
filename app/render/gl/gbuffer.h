/* SPDX-License-Identifier: MIT */
/* gbuffer.h - the G-buffer on the CPU. */
#ifndef LAMPION_RENDER_GL_GBUFFER_H
#define LAMPION_RENDER_GL_GBUFFER_H

#include "app/render/gl/targets.h"
#include "app/render/surfaces.h"

typedef struct gpu_pair16 {
    uint16_t u, v;
} gpu_pair16;

typedef struct gpu_pair8 {
    uint8_t u, v;
} gpu_pair8;

typedef struct gpu_base16 {
    uint16_t root[3], metallic;
} gpu_base16;

typedef struct gpu_coat16 {
    uint16_t u, v, weight, roughness;
} gpu_coat16;

/* The attachments as they are stored (shared.h). */
typedef struct gpu_gbuffer {
    int width, height;
    float *depth;
    gpu_base16 *base_metallic;
    gpu_pair16 *normal, *roughness_kind;
    vec4 *emission;
    gpu_pair8 *weights;
    gpu_coat16 *coat; /* and the attachments after it: NULL if no material is layered */
    uint8_t (*tint)[4], (*sheen)[4];
    vec4 *rgba;               /* radiance that the CPU computes */
    render_surfaces surfaces; /* decoded from the attachments */
} gpu_gbuffer;

/* Reads and decodes a sample, whose depths are relative to `reach` (frame.h); allocates at the
 * first frame of a size. */
bool gpu_gbuffer_read(const gpu_targets *targets, const render_materials *materials,
                      const environment *around, const render_camera *camera, float reach,
                      const render_frame *frame, gpu_gbuffer *gbuffer, base_error *error);
void gpu_gbuffer_free(gpu_gbuffer *gbuffer);

#endif
