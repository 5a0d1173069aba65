/* SPDX-License-Identifier: MIT */
/* zonal.h - the zonal coefficients of a cap by other formulas in the literature, for comparison
 * with the library's (docs/accuracy.md). */
#ifndef APP_ZONAL_ZONAL_H
#define APP_ZONAL_ZONAL_H

#include <lampion/light.h>

/* Evaluates the paper's Eq. 12 exactly as printed, from cos a in -1 … 1, radiance 1; float32
 * cancels for small lights. zonal receives `bands` values, as in the functions below. */
void zonal_printed(int bands, float cos_a, float *zonal);

/* Evaluates Sloan's closed forms (2008), factored; bands <= ZONAL_SLOAN_BANDS. */
#define ZONAL_SLOAN_BANDS 6
void zonal_sloan(int bands, float cos_a, float *zonal);

/* The paper's tabulation of Z_l against cos a (§4.2), linear between `size` >= 2 entries that span
 * -1 … 1. zonal_table_create returns NULL if memory ran out. Immutable; destroy accepts NULL. */
typedef struct zonal_table zonal_table;
zonal_table *zonal_table_create(int bands, int size);
void zonal_table_destroy(zonal_table *table);
void zonal_table_eval(const zonal_table *table, float cos_a, float *zonal);

#endif
