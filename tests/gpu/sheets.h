/* SPDX-License-Identifier: MIT */
/* sheets.h - a scene of four sheets of known materials, and frames that look at one. */
#ifndef LAMPION_TESTS_GPU_SHEETS_H
#define LAMPION_TESTS_GPU_SHEETS_H

#include "app/render/gl/gpu.h"
#include "tests/oracle/placed.h"

#include <math.h>
#include <string.h>

enum { SIDE = 64, PIXELS = SIDE * SIDE, MATERIALS = 4 };

/* A square of 2 x 2 in z = 0, its front to +z, once for each material at x = 0, 10, 20 … */
typedef struct sheets {
    scene world;
    scene_vertex vertices[4 * MATERIALS];
    uint32_t indices[6 * MATERIALS];
    scene_mesh meshes[MATERIALS];
    scene_material materials[MATERIALS];
    scene_texture textures[2];
    unsigned char texels[2 * 4 * 4];
    scene_light lights[SCENE_LIGHTS_MAX];
} sheets;

static sheets sheet;

static inline void lay_sheet(int i) {
    static const float corners[4][2] = { { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } };
    static const uint32_t order[6] = { 0, 1, 2, 0, 2, 3 };
    for (int k = 0; k < 4; k++)
        sheet.vertices[4 * i + k] =
            (scene_vertex) { .position = { 10 * (float)i + corners[k][0], corners[k][1], 0 },
                             .normal = { 0, 0, 1 },
                             .uv = { { 0.5f + 0.5f * corners[k][0], 0.5f - 0.5f * corners[k][1] } },
                             .tangent = { 1, 0, 0, 1 } };
    for (int k = 0; k < 6; k++)
        sheet.indices[6 * i + k] = order[k] + 4 * (uint32_t)i;
    sheet.meshes[i] = (scene_mesh) { .first_index = 6 * (uint32_t)i,
                                     .index_count = 6,
                                     .material = (uint32_t)i,
                                     .minimum = { 10 * (float)i - 1, -1, 0 },
                                     .maximum = { 10 * (float)i + 1, 1, 0 } };
    sheet.materials[i] = scene_material_plain();
}

/* Texture 0: left half opaque red, right half transparent green (2x2 texels); texture 1: a normal
 * that leans to +x by 3:4:5. */
static inline void paint(void) {
    static const unsigned char mask[16] = { 255, 0, 0, 255, 0, 255, 0, 0,
                                            255, 0, 0, 255, 0, 255, 0, 0 };
    memcpy(sheet.texels, mask, sizeof mask);
    for (int i = 0; i < 4; i++) {
        const unsigned char texel[4] = { 204, 128, 230, 255 }; /* (0.6, 0.004, 0.804) */
        memcpy(sheet.texels + 16 + 4 * i, texel, sizeof texel);
    }
    for (uint32_t i = 0; i < 2; i++)
        sheet.textures[i] = (scene_texture) { .width = 2,
                                              .height = 2,
                                              .srgb = i == 0,
                                              .wrap_u = SCENE_WRAP_CLAMP,
                                              .wrap_v = SCENE_WRAP_CLAMP,
                                              .first_byte = 16 * i };
}

static inline scene *make_sheets(void) {
    memset(&sheet, 0, sizeof sheet);
    for (int i = 0; i < MATERIALS; i++)
        lay_sheet(i);
    paint();
    sheet.materials[0].flags = SCENE_DOUBLE_SIDED;
    sheet.materials[1].flags = SCENE_ALPHA_MASK | SCENE_DOUBLE_SIDED;
    sheet.materials[1].alpha_cutoff = 0.5f;
    sheet.materials[1].base_color_map.texture = 0;
    sheet.materials[2].normal_map.texture = 1;
    sheet.materials[3].metallic = 1;
    sheet.materials[3].roughness = 0;
    sheet.materials[3].emission[1] = 2;
    sheet.world = (scene) { .vertices = sheet.vertices,
                            .indices = sheet.indices,
                            .meshes = sheet.meshes,
                            .instances = placed_meshes(MATERIALS),
                            .materials = sheet.materials,
                            .textures = sheet.textures,
                            .texels = sheet.texels,
                            .vertex_count = 4 * MATERIALS,
                            .index_count = 6 * MATERIALS,
                            .mesh_count = MATERIALS,
                            .instance_count = MATERIALS,
                            .material_count = MATERIALS,
                            .texture_count = 2,
                            .texel_bytes = sizeof sheet.texels,
                            .lights = sheet.lights,
                            .minimum = { -1, -1, 0 },
                            .maximum = { 31, 1, 0 },
                            .name = "sheets" };
    return &sheet.world;
}

/* Returns a frame that looks at sheet i from z = ±3: the sheet fills the middle half of the view's
 * height. */
static inline render_frame look_at(const scene *world, int i, float side) {
    return (render_frame) { .width = SIDE,
                            .height = SIDE,
                            .camera = { .eye = { 10 * (float)i, 0, 3 * side },
                                        .target = { 10 * (float)i, 0, 0 },
                                        .up = { 0, 1, 0 },
                                        .fov = 2 * atanf(2 / 3.0f) },
                            .bands = 3,
                            .lights = world->lights,
                            .light_count = world->light_count };
}

#endif
