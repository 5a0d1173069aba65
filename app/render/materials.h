/* SPDX-License-Identifier: MIT */
/* materials.h - the materials of a scene in the form that shading reads. */
#ifndef LAMPION_RENDER_MATERIALS_H
#define LAMPION_RENDER_MATERIALS_H

#include "app/base/error.h"
#include "app/scene/scene.h"

#define RENDER_TABLES_MAX 64

/* The constants of a material, which do not vary over its surfaces. */
typedef struct render_material_constants {
    float f0[3], f90; /* as in scene_material */
    bool layered, sheen, translucent;
    int table; /* the table that replaces the material, or -1 */
} render_material_constants;

typedef struct render_materials {
    render_material_constants *of; /* one per material of the scene */
    size_t count;
    bool layered, translucent, blends; /* whether any material is, or blends by its alpha */
    const lmp_brdf_table *tables[RENDER_TABLES_MAX]; /* not owned, nor are the arrays below */
    int table_count, table_bands;
    const lmp_preintegrated_brdf *brdfs[RENDER_TABLES_MAX]; /* of the tables, or NULL */
    /* Tables of white sheen, or NULL if sheen is not drawn. */
    const lmp_brdf_table *sheen_tables[LMP_SHEEN_TABLES];
    bool sheen_noted; /* whether a note has said that sheen is unsupported */
} render_materials;

/* Copies what shading needs of the scene's materials. Returns false if memory ran out. */
bool render_materials_create(const scene *scene, render_materials *materials);
void render_materials_free(render_materials *materials);

/* Replaces materials of the scene by tables: uses[i] is the table of material i, or -1. The tables
 * must outlive the materials, and have the bands of the frames to come. Removes all preintegrated
 * BRDFs. */
bool render_materials_set_tables(render_materials *materials, const lmp_brdf_table *const *tables,
                                 int count, const int *uses, base_error *error);

/* Sets the preintegrated BRDFs after render_materials_set_tables: brdfs[i] of table i, or NULL;
 * brdfs may be NULL. */
void render_materials_set_brdfs(render_materials *materials,
                                const lmp_preintegrated_brdf *const *brdfs);

/* Sets the LMP_SHEEN_TABLES tables of white sheen, or NULL; the array itself need not stay. */
void render_materials_set_sheen(render_materials *materials, const lmp_brdf_table *const *white);

/* Whether material `number` has layers beyond glTF's core and no table replaces it. */
bool render_material_is_layered(const render_materials *materials, size_t number);

/* Whether material `number` transmits light from behind; a table never does. */
bool render_material_is_translucent(const render_materials *materials, size_t number);

/* Fills in a library material for a surface of material `number`, with factors on its dielectric
 * reflection and F0; base color, metalness, roughness and layers are set separately per surface. */
void render_material_fill(const render_materials *materials, size_t number, float specular,
                          lmp_rgb tint, lmp_material *material);

/* Adds the layers of a layered material: a coat, and a sheen if tables of sheen are set. */
void render_material_cover(const render_materials *materials, lmp_coat coat, lmp_rgb sheen,
                           float sheen_roughness, lmp_material *material);

/* Notes once on stderr that sheen is unsupported, if materials have any and `drawn` is false. */
void render_materials_note_sheen(render_materials *materials, bool drawn);

/* Returns a diffuse material that reflects nothing else. */
lmp_material render_material_matte(lmp_rgb color);

/* Returns how many materials have a sheen. */
unsigned render_materials_sheens(const render_materials *materials);

#endif
