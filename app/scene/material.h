/* SPDX-License-Identifier: MIT */
/* material.h - materials by name: files of measured BRDFs, tables, and parametric ones.
 *
 *     FILE.binary, FILE.bsdf, FILE.lmpt    told apart by their content
 *     sgd:NAME, sgd:FILE.csv:NAME          the SGD fits of MERL: built in, or from a table
 *     lambert:COLOR                        albedo
 *     phong:EXPONENT[:COLOR]               reflectance 1
 *     ggx:ALPHA[xALPHA_Y][:F0[:DIFFUSE]]   F0 0.04, diffuse 0
 *     gltf:COLOR:ROUGHNESS:METALLIC        GGX by glTF's factors, of a dielectric of F0 0.04
 *     sheen:ROUGHNESS[:COLOR[:DIFFUSE]]    color 1, diffuse 0
 *
 * A COLOR is one number or R,G,B. */
#ifndef LAMPION_SCENE_MATERIAL_H
#define LAMPION_SCENE_MATERIAL_H

#include "app/base/error.h"
#include "app/base/file_hash.h"

#include <lampion/preintegrated.h>

#define MATERIAL_NAMES                                                                             \
    "FILE.binary, FILE.bsdf, FILE.lmpt, sgd:NAME, lambert:COLOR, phong:EXPONENT, ggx:ALPHA, "      \
    "gltf:COLOR:ROUGHNESS:METALLIC or sheen:ROUGHNESS"

/* A material by name; either brdf or table is not NULL. */
typedef struct material {
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    const char *name;
    size_t file_size; /* 0 if the material is not a file */
    file_hash hash;   /* of the data it was made from */
} material;

bool material_open(const char *name, material *material, base_error *error);

/* Returns the file that reading a material opens, the first *length bytes of a name; NULL if it
 * opens none. */
const char *material_file_named(const char *name, size_t *length);
void material_close(material *material);

/* Returns the properties of the table that material_bake would make or read: bands, azimuths and
 * symmetry (mirrored unless it cannot be). */
lmp_brdf_table_info material_plan(const material *material, const lmp_brdf_table_desc *desc);

/* Tabulates the material on all cores, with a progress bar, or reads the table from the cache. A
 * material that is a table is copied and keeps its own bands and window. */
bool material_bake(const material *material, const lmp_brdf_table_desc *desc,
                   lmp_brdf_table **table, base_error *error);

/* Preintegrates a material's table as material_bake makes it; returns NULL where no preintegrated
 * BRDF fits (an anisotropic one has one more dimension) and says so on stderr. Free with
 * lmp_preintegrated_brdf_destroy. */
bool material_preintegrate(const material *material, const lmp_brdf_table *table,
                           lmp_preintegrated_brdf **brdf, base_error *error);

/* Writes a table to a file. */
bool material_write_table(const lmp_brdf_table *table, const char *path, base_error *error);

#endif
