/* SPDX-License-Identifier: MIT */
/* shared.h - what the program's C and its shaders must agree on: blocks, bindings, the tone curve.
 *
 * Included by both. The blocks hold only vec4 and mat4, so std140 lays them out as C does. */
#ifndef LAMPION_SHADERS_SHARED_H
#define LAMPION_SHADERS_SHARED_H

#ifdef LAMPION_SHADER
#define SHARED_BLOCK(type, name, point) layout(std140, binding = point) uniform type
#define SHARED_END(name)
#else
#include <assert.h>
#include <stddef.h>
typedef float vec4[4];
typedef float mat4[16]; /* column-major */
#define SHARED_BLOCK(type, name, point) typedef struct name
#define SHARED_END(name)                name
#endif

#define SHARED_LIGHTS_MAX 65537 /* one of them stands for what all skies have in common */

/* Uniform block bindings. */
#define SHARED_FRAME    0
#define SHARED_MATERIAL 2

/* Storage blocks of the lights, of those that are areas (areas.glsl), of the tables (table.glsl),
 * and of the lobes of GGX (material.glsl). The last three, like coefficients of the environment and
 * nodes of a field below, are arrays of texels.glsl, whose textures have the units from
 * SHARED_TEXELS on. */
#define SHARED_TEXELS 20
#define SHARED_LIGHTS 7
#define SHARED_AREAS  0
#define SHARED_TABLES 1
#define SHARED_GGX    2

/* Texels of an area, LMP_AREA_TEXELS of lampion/light.h, and the one whose w is the area's number
 * among all lights, or -1 if it is not drawn. */
#define SHARED_AREA_TEXELS 11
#define SHARED_AREA_NUMBER 10

/* Texture units of the materials' maps, and of the G-buffer in the passes that read it. */
#define SHARED_BASE_COLOR         0
#define SHARED_METALLIC_ROUGHNESS 1
#define SHARED_NORMAL             2
#define SHARED_EMISSION           3
#define SHARED_DEPTH              4
#define SHARED_WEIGHTS            10 /* of the G-buffer */
#define SHARED_COAT               11
#define SHARED_TINT               12
#define SHARED_SHEEN              13
#define SHARED_OCCLUSION          10 /* of materials, from here on consecutive */
#define SHARED_MAPS               14
#define SHARED_INSTANCE_MOVES     0x80000000u /* set where an instance's matrix is no identity */
#define SHARED_HDR                5

/* Maps by their index in the block, as in scene_material. */
#define SHARED_MAP_OCCLUSION      4
#define SHARED_MAP_SPECULAR       5
#define SHARED_MAP_SPECULAR_COLOR 6
#define SHARED_MAP_COAT           7
#define SHARED_MAP_COAT_ROUGHNESS 8
#define SHARED_MAP_COAT_NORMAL    9
#define SHARED_MAP_SHEEN_COLOR    10
#define SHARED_MAP_SHEEN_ROUGH    11
#define SHARED_MAP_THROUGH        12
#define SHARED_MAP_THROUGH_COLOR  13

/* Fragment outputs, in the order of the G-buffer's attachments (34 bytes a pixel, and depth):
 *   0  RGBA16          square root of the base color, metallic
 *   1  RG16            octahedral normal; of a light, its index in r
 *   2  RG16            roughness, kind
 *   3  RGBA32F         emitted radiance, as seen through a coat (R11F_G11F_B10F in the browser's
 *                      page, which shows no .exr); a: for surfaces that let light through from
 *                      behind, its color, the square roots as three bytes of an integer
 *   4  RG8             fraction of ambient light that arrives, a factor on the dielectric's
 *                      reflection
 * and, in scenes that have such layers, written and read only for materials with one (16 bytes):
 *   5  RGBA16          of a coat: octahedral normal, weight, roughness
 *   6  RGBA8           square root of a factor on the dielectric's F0
 *   7  RGBA8           square root of the color of a sheen, its roughness
 * The square root keeps dark colors precise: one of 0.0005 to 7e-4 of itself, brighter ones to
 * less. Every device squares it alike. */
#define SHARED_KIND_NONE     0
#define SHARED_KIND_LIGHT    1
#define SHARED_KIND_SURFACE  2 /* and up: a surface of material number kind - 2 */
#define SHARED_MATERIALS_MAX (65536 - SHARED_KIND_SURFACE)

/* Storage block of the parameters that a material has everywhere. */
#define SHARED_MATERIAL_CONSTANTS 6
#ifdef LAMPION_SHADER
struct shared_material_constants {
#else
typedef struct shared_material_constants {
#endif
    vec4 dielectric; /* F0, not held to 1, and what weighs it, which is F90 */
    vec4 table;      /* x: the number of its table, or -1; y: 1 if it has layers */
#ifdef LAMPION_SHADER
};
#else
} shared_material_constants;
#endif

/* Tables and least roughness of sheen, as in lmp_sheen_layer. */
#define SHARED_SHEEN_TABLES        16
#define SHARED_SHEEN_ROUGHNESS_MIN 0.07

/* Texture unit and storage block of a preintegrated lobe (lampion/preintegrated.h), and the most
 * cells and the entries of the remap that the block holds: those of 128 bands at the default error
 * fit. */
#define SHARED_PREINTEGRATED_LOBE_PAIRS 6
#define SHARED_PREINTEGRATED_LOBE       3
#define SHARED_PREINTEGRATED_LOBE_CELLS 128
#define SHARED_PREINTEGRATED_LOBE_REMAP 321

/* Texture unit and storage block of preintegrated BRDFs (preintegrated_brdf.glsl). */
#define SHARED_PREINTEGRATED_BRDF_TEXELS 8
#define SHARED_PREINTEGRATED_BRDF        4

/* Storage blocks of a field's nodes, and of what else there is of it (field.glsl), which no method
 * reads that reads a preintegrated lobe. */
#define SHARED_FIELD_NODES 3
#define SHARED_FIELD       4

/* Storage blocks of the coarser field in the pass that computes nodes (field_nodes.comp), which
 * reads neither an environment nor materials. */
#define SHARED_FIELD_COARSER_NODES 5
#define SHARED_FIELD_COARSER       6
#define SHARED_FIELD_BANDS         4 /* bands of a column that one thread computes */

/* The layout of a field, before its lists, which are uint; as std430. */
#ifdef LAMPION_SHADER
struct shared_field {
#else
typedef struct shared_field {
#endif
    vec4 origin;   /* position of the first node; w: 1 / reach */
    vec4 per_cell; /* 1 / edges of a cell; w: number of lights */
    vec4 cell;
    vec4 nodes; /* nodes along x, y, z */
#ifdef LAMPION_SHADER
};
#else
} shared_field;
#endif

/* Texture unit of the paper's tabulated Z_l, 4 bands per row, and its number of entries. */
#define SHARED_ZONAL         7
#define SHARED_ZONAL_ENTRIES 1024

/* Texture unit of the visible environment, and storage block of its coefficients
 * (environment.glsl). */
#define SHARED_BACKDROP    9
#define SHARED_ENVIRONMENT 5

/* Side of the square of pixels one compute group shades: 64 threads. */
#define SHARED_GROUP 8

SHARED_BLOCK(frame_block, shared_frame, SHARED_FRAME) {
    mat4 clip_from_world;
    vec4 eye;        /* w: distance of the near plane; of parallel rays, of the farthest triangle */
    vec4 forward;    /* unit; w: 1 if the rays are parallel */
    vec4 right;      /* to the right edge of the view at distance 1, or at any */
    vec4 down;       /* to its bottom edge */
    vec4 background; /* radiance of the background; w: depth of the far plane, or 0 */
    vec4 size_lights; /* width, height, number of lights, and of those that are areas */
    vec4 jitter; /* the sample's position in its pixel, 0 in the middle; the view is -1 … 1; z, w:
                    its index, of how many */
    vec4 surroundings; /* of the environment: bands (0: none), azimuth, 1 if it is visible,
                          coefficients of its block */
}
SHARED_END(shared_frame);

/* A light (lmpi_packed_light): a sphere that is drawn; a sphere or a Dirac that only shades; a
 * Dirac that falls off around an axis; or a light that is the same from every point, with its axis
 * and 1 - cos a in place of center and radius. A negative size marks a Dirac. In the place of an
 * area, whose texels are elsewhere, is a sphere of radius 0, which gives no light. */
#define SHARED_LIGHT_DRAWN  0
#define SHARED_LIGHT_HIDDEN 1
#define SHARED_LIGHT_CONE   2
#define SHARED_LIGHT_FIXED  3
#ifdef LAMPION_SHADER
struct shared_light {
#else
typedef struct shared_light {
#endif
    vec4 sphere;   /* center, radius */
    vec4 radiance; /* or what a Dirac has in its place; w: SHARED_LIGHT_… */
    vec4 cone;     /* parameters of a cone's falloff */
#ifdef LAMPION_SHADER
};
#else
} shared_light;
#endif

#ifdef SHARED_WITHOUT_STORAGE /* as in a page, whose uniform block holds fewer */
layout(std140) uniform lights_block {
    shared_light lights[SHARED_LIGHTS_MAX];
};
#elif defined(LAMPION_SHADER)
layout(std430, binding = SHARED_LIGHTS) readonly buffer lights_block {
    shared_light lights[];
};
#endif

/* The block of a material. For a map, matrix is KHR_texture_transform's, row-major; offset's z is
 * the set of coordinates. maps: 1 where a map is bound. */
SHARED_BLOCK(material_block, shared_material, SHARED_MATERIAL) {
    vec4 base_color;
    vec4 emission; /* w: kind */
    vec4 factors;  /* metallic, roughness, normal scale, alpha cutoff */
    vec4 maps;     /* base color, metallic-roughness, normal, emission */
    vec4 vertex;   /* x: 1 where the vertices' colors apply; y: strength of the occlusion map; z: 1
                      where alpha blends; w: 1 where the vertices' colors tint the emission */
    vec4 coat;     /* weight, roughness, normal scale */
    vec4 sheen;    /* color, roughness */
    vec4 transmission; /* color, and the part of the diffuse light that comes through; with part
                          -1, of leaves, the color is a factor on the base's, which keeps all */
    vec4 more[3];      /* further maps, after the first four */
    vec4 matrix[SHARED_MAPS];
    vec4 offset[SHARED_MAPS];
}
SHARED_END(shared_material);

/* A pixel as gpu_read_pixels reads it back: lmp_surface and lmp_material as evaluated. */
#ifdef LAMPION_SHADER
struct shared_pixel {
#else
typedef struct shared_pixel {
#endif
    vec4 position_kind;
    vec4 normal_metallic;
    vec4 view_roughness;
    vec4 base_color;
    vec4 emission;
    vec4 weights; /* as in the G-buffer */
    vec4 coat;    /* normal, weight */
    vec4 tint;    /* factor on F0; roughness of the coat */
    vec4 sheen;   /* color, roughness */
#ifdef LAMPION_SHADER
};
#else
} shared_pixel;

/* A preintegrated lobe without its coefficients, as std430. cells: scale, offset, and the corner in
 * the texture. */
typedef struct shared_preintegrated_lobe {
    vec4 shape; /* width2, number of cells, size of a texel */
    vec4 cells[SHARED_PREINTEGRATED_LOBE_CELLS];
    float remap[SHARED_PREINTEGRATED_LOBE_REMAP];
} shared_preintegrated_lobe;

static_assert(offsetof(shared_frame, eye) == 64, "std140");
static_assert(offsetof(shared_frame, size_lights) == 144, "std140");
static_assert(sizeof(shared_frame) == 192, "std140");
static_assert(sizeof(shared_light) == 48, "std140");
static_assert(offsetof(shared_material, matrix) == 176, "std140");
static_assert(offsetof(shared_material, offset) == 400, "std140");
static_assert(sizeof(shared_material) == 624, "std140");
static_assert(sizeof(shared_pixel) == 144, "std430");
static_assert(sizeof(shared_material_constants) == 32, "std430");
static_assert(sizeof(shared_field) == 64, "std430");
#endif

#endif
