/* SPDX-License-Identifier: MIT */
/* state.h - a renderer: the data of each pass, side by side. */
#ifndef LAMPION_RENDER_GL_STATE_H
#define LAMPION_RENDER_GL_STATE_H

#include "app/render/gl/clock.h"
#include "app/render/gl/field.h"
#include "app/render/gl/gbuffer.h"
#include "app/render/gl/preintegrated_brdf.h"
#include "app/render/gl/preintegrated_lobe.h"
#include "app/render/gl/sheen.h"
#include "app/render/gl/table.h"
#include "app/render/gl/variant.h"
#include "app/render/gl/zonal.h"

struct gpu_renderer {
    gpu_context context;
    scene bounds; /* a scene that has bounds only */
    gpu_mesh mesh;
    render_materials materials;
    gpu_surfaces surface;                   /* programs, as are those that follow */
    GLuint light, areas, surfaces, resolve; /* areas: once a frame has any */
    GLuint tones[IMAGE_TONES_MAX];          /* by the rows of image_tones */
    GLuint frame_block, empty_array;
    gpu_texels ggx;
    gpu_variants variants;
    gpu_lights lights;
    gpu_zonal zonal;
    gpu_preintegrated_lobe lobe;
    gpu_preintegrated_brdfs brdfs;
    gpu_tables tables;
    gpu_sheen sheen;
    gpu_environment environment;
    gpu_field field;
    gpu_targets targets;
    gpu_clock clock;
    gpu_gbuffer gbuffer; /* for shading on the CPU */
};

#endif
