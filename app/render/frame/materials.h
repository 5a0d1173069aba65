/* SPDX-License-Identifier: MIT */
/* materials.h - what the materials of a scene are shaded by. */
#ifndef LAMPION_RENDER_MATERIALS_H
#define LAMPION_RENDER_MATERIALS_H

#include "app/cli/cli.h"
#include "app/scene/scene.h"

#define RENDER_TABLES_MAX 64

/* What a material is all over. */
typedef struct render_reflector {
    float f0[3], f90; /* as in scene_material */
    bool layered, sheen;
    int table; /* instead of all that, or -1 */
} render_reflector;

typedef struct render_materials {
    render_reflector *of; /* the scene's materials */
    size_t count;
    bool layered;                                    /* some material is */
    const lmp_brdf_table *tables[RENDER_TABLES_MAX]; /* not owned, as those after it */
    int table_count, table_bands;
    const lmp_preintegrated_brdf *brdfs[RENDER_TABLES_MAX]; /* of the tables, or NULL */
    const lmp_brdf_table *const *fibers; /* of white fibers, by which sheen is drawn; or NULL */
    bool sheen_noted;                    /* that it is left out */
} render_materials;

/* Copies what it needs of the scene. False without memory. */
bool render_materials_create(const scene *scene, render_materials *materials);
void render_materials_free(render_materials *materials);

/* Shades materials of the scene by tables instead: uses[i] is the table of material i, or -1. The
 * tables must outlive the materials; all have the bands of the frames to come. None of them is
 * preintegrated from then on. */
bool render_materials_set_tables(render_materials *materials, const lmp_brdf_table *const *tables,
                                 int count, const int *uses, cli_error *error);

/* After that: brdfs[i] of table i, or NULL, for methods that read them; brdfs may be NULL. */
void render_materials_set_brdfs(render_materials *materials,
                                const lmp_preintegrated_brdf *const *brdfs);

/* Whether material `number` has more than glTF's core, which no table replaces. */
bool render_material_is_layered(const render_materials *materials, size_t number);

/* What the library is told of a surface of material `number`, with factors on its dielectric's
 * reflection and F0; base color, metalness, roughness and layers are the surface's own. */
void render_material_fill(const render_materials *materials, size_t number, float specular,
                          lmp_rgb tint, lmp_material *material);

/* What lies over it, if the material is layered: a coat, and a sheen where tables draw it. */
void render_material_cover(const render_materials *materials, lmp_coat coat, lmp_rgb sheen,
                           float sheen_roughness, lmp_material *material);

/* Says once on stderr that sheen is left out, if materials have one and `drawn` is false. */
void render_materials_note_sheen(render_materials *materials, bool drawn);

/* How many materials have a sheen of their own. */
unsigned render_materials_sheens(const render_materials *materials);

#endif
