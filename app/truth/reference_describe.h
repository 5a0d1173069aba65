/* SPDX-License-Identifier: MIT */
/* reference_describe.h - what a surface is made of where a ray hits it: its material, with the
 * texels of its textures there. */
#ifndef LAMPION_TRUTH_REFERENCE_DESCRIBE_H
#define LAMPION_TRUTH_REFERENCE_DESCRIBE_H

#include "app/truth/reference_lobe.h"
#include "app/truth/reference_trace.h"

/* The materials of a scene, and what replaces them. */
typedef struct reference_materials {
    const scene *scene;
    const reference_material_source *sources; /* one per material; or NULL */
    const reference_sheen_albedos *albedos;   /* if any material has a sheen */
    reference_band_limit band_limit;
} reference_materials;

/* A surface that points to the BRDFs beside it. */
typedef struct reference_description {
    reference_surface surface;
    double emission[3];
    reference_tabulated tabulated;
    reference_ggx ggx, coat;
    reference_sheen sheen;
} reference_description;

/* Prepares a description for surfaces of these materials; returns false if memory ran out. Free it
 * in any case. */
bool reference_description_create(const reference_materials *materials,
                                  reference_description *description);
void reference_description_free(reference_description *description);

/* Describes the surface as seen from the unit direction `view`, and the light that it emits. */
void reference_describe(const reference_materials *materials, const reference_hit *hit,
                        reference_vec view, reference_description *description);

/* Returns the opacity of a blended material; 1 for any other. */
double reference_opacity(const reference_materials *materials, const reference_hit *hit);

#endif
