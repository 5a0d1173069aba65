/* SPDX-License-Identifier: MIT */
/* tabulated.h - a BRDF, or the table of its truncated series, seen from one surface point. */
#ifndef LAMPION_REFERENCE_TABULATED_H
#define LAMPION_REFERENCE_TABULATED_H

#include "app/file/file.h"
#include "app/reference/vector.h"

#include <lampion/brdf.h>
#include <stdbool.h>

/* What to reflect by instead of the scene's lobes: a BRDF, or coefficients laid out as
 * lmp_brdf_table_coefficients of the table; or neither. */
typedef struct reference_material_source {
    const lmp_brdf *brdf;
    const float *coefficients;
    lmp_brdf_table_info table;
    file_hash made_from; /* tells parts of other materials apart */
} reference_material_source;

/* One a thread, oriented again for each point. */
typedef struct reference_tabulated {
    const reference_material_source *source;
    double *coefficients; /* of the table's view */
    reference_vec x, y, z;
    double wo[3]; /* the view in the frame x, y, z */
} reference_tabulated;

/* For any of `count` sources. False without memory. */
bool reference_tabulated_create(reference_tabulated *tabulated,
                                const reference_material_source *sources, size_t count);
void reference_tabulated_free(reference_tabulated *tabulated);

/* A source with a BRDF or a table. The vectors must be unit; the tangent is the material's x axis
 * once it is square to the normal.
 */
void reference_tabulated_orient(reference_tabulated *tabulated,
                                const reference_material_source *source, reference_vec normal,
                                reference_vec tangent, reference_vec view);

/* f_r cos(theta) of light from w, or the value of its series, which may be negative. */
void reference_tabulated_at(const reference_tabulated *tabulated, reference_vec w, double rgb[3]);

#endif
