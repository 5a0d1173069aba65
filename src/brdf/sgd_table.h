/* SPDX-License-Identifier: MIT */
/* sgd_table.h - the built-in SGD materials. sgd_table.c is written by generate/sgd_table.awk; a
 * test holds the two together. */
#ifndef LAMPION_BRDF_SGD_TABLE_H
#define LAMPION_BRDF_SGD_TABLE_H

#include <lampion/brdf.h>

typedef struct brdf_sgd_row {
    const char *name, *alias; /* alias may be empty */
    lmp_sgd sgd;
} brdf_sgd_row;

extern const brdf_sgd_row lmpi_sgd_rows[];
extern const size_t lmpi_sgd_row_count;

#endif
