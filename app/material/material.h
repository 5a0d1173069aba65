/* SPDX-License-Identifier: MIT */
/* material.h - materials by name: files of measured BRDFs, tables, and parametric ones.
 *
 *     FILE.binary, FILE.bsdf, FILE.lmpt    told apart by their content
 *     sgd:NAME, sgd:FILE.csv:NAME          the SGD fits of MERL: built in, or from a table
 *     lambert:COLOR                        albedo
 *     phong:EXPONENT[:COLOR]               reflectance 1
 *     ggx:ALPHA[xALPHA_Y][:F0[:DIFFUSE]]   F0 0.04, diffuse 0
 *     sheen:ROUGHNESS[:COLOR[:DIFFUSE]]    color 1, diffuse 0
 *
 * A COLOR is one number or R,G,B. */
#ifndef LAMPION_MATERIAL_H
#define LAMPION_MATERIAL_H

#include "app/cli/cli.h"
#include "app/file/file.h"

#include <lampion/preintegrated.h>

#define MATERIAL_NAMES                                                                             \
    "FILE.binary, FILE.bsdf, FILE.lmpt, sgd:NAME, lambert:COLOR, phong:EXPONENT, ggx:ALPHA or "    \
    "sheen:ROUGHNESS"

/* One of brdf and table is there. */
typedef struct material {
    lmp_brdf *brdf;
    lmp_brdf_table *table;
    const char *name;
    size_t file_size; /* 0: not a file */
    file_hash hash;   /* of what it was made from */
} material;

bool material_open(const char *name, material *material, cli_error *error);

/* The file that a material's name makes it open: so many bytes of the name; NULL if it is none. */
const char *material_file_named(const char *name, size_t *length);
void material_close(material *material);

/* What is known of the table that material_bake would make, or is read from: its bands, azimuths
 * and symmetry (mirrored unless it cannot be). */
lmp_brdf_table_info material_plan(const material *material, const lmp_brdf_table_desc *desc);

/* A table of the material on all cores, with a progress bar, from the cache where it was made
 * before. A material that is a table is copied: its bands and window
 * are then its own. */
bool material_bake(const material *material, const lmp_brdf_table_desc *desc,
                   lmp_brdf_table **table, cli_error *error);

/* The same of a material's table, preintegrated: NULL where there is none that fits (an anisotropic
 * one has a dimension more), which it says on stderr. Free with lmp_preintegrated_brdf_destroy. */
bool material_preintegrate(const material *material, const lmp_brdf_table *table,
                           lmp_preintegrated_brdf **brdf, cli_error *error);

/* Writes a table to a file. */
bool material_write_table(const lmp_brdf_table *table, const char *path, cli_error *error);

#endif
