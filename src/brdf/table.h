/* SPDX-License-Identifier: MIT */
/* table.h - the inside of a table, for its maker, its file format and its reader. */
#ifndef LAMPION_BRDF_TABLE_H
#define LAMPION_BRDF_TABLE_H

#include "src/brdf/brdf.h"

#define BRDF_VIEWS_MAX    1024
#define BRDF_AZIMUTHS_MAX 256

struct lmp_brdf_table {
    lmp_host host;
    lmp_brdf_table_info info;
    float *coefficients; /* [azimuth][view][channel][count] */
};

/* Allocates a table of the shape in info (bands, views, azimuths, mirrored), and sets the members
 * that follow from it. */
lmp_result lmpi_brdf_table_new(const lmp_host *host, const lmp_brdf_table_info *info,
                               lmp_brdf_table **table);

/* Does lmp_brdf_table_interpolate for bands low … high-1; returns how many coefficients a channel
 * has there. */
size_t lmpi_brdf_table_bands(const lmp_brdf_table *table, float cos_theta_o, float phi_o, int low,
                             int high, float *rgb);

#endif
