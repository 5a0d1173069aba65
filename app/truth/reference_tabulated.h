/* SPDX-License-Identifier: MIT */
/* reference_tabulated.h - a BRDF, or the table of its truncated series, at one surface point. */
#ifndef LAMPION_TRUTH_REFERENCE_TABULATED_H
#define LAMPION_TRUTH_REFERENCE_TABULATED_H

#include "app/base/file_hash.h"
#include "app/truth/reference_vector.h"

#include <lampion/brdf.h>
#include <stdbool.h>

/* What reflects instead of the scene's lobes: a BRDF, or coefficients in the layout of
 * lmp_brdf_table_coefficients of the table; or neither. */
typedef struct reference_material_source {
    const lmp_brdf *brdf;
    const float *coefficients;
    lmp_brdf_table_info table;
    file_hash made_from; /* distinguishes parts with different materials */
} reference_material_source;

/* A tabulated material at a point; one per thread, oriented again for each point. */
typedef struct reference_tabulated {
    const reference_material_source *source;
    double *coefficients; /* of the table, for the view */
    reference_vec x, y, z;
    double wo[3]; /* the view in the frame x, y, z */
} reference_tabulated;

/* Prepares for any of `count` sources; returns false if memory ran out. */
bool reference_tabulated_create(reference_tabulated *tabulated,
                                const reference_material_source *sources, size_t count);
void reference_tabulated_free(reference_tabulated *tabulated);

/* Orients a source that has a BRDF or a table. The vectors must be unit; the tangent, made
 * perpendicular to the normal, becomes the material's x axis. */
void reference_tabulated_orient(reference_tabulated *tabulated,
                                const reference_material_source *source, reference_vec normal,
                                reference_vec tangent, reference_vec view);

/* Evaluates f_r cos(theta) for light from w, or the value of its series, which may be negative. */
void reference_tabulated_at(const reference_tabulated *tabulated, reference_vec w, double rgb[3]);

#endif
