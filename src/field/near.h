/* SPDX-License-Identifier: MIT */
/* near.h - the lists of the lights that are near each block of cells. */
#ifndef LAMPION_FIELD_NEAR_H
#define LAMPION_FIELD_NEAR_H

#include "src/field/grid.h"

/* Put a light into the lists of the blocks near it, remove it from them, or do both for a light
 * that was the sphere `was` when it was listed; unlist_all empties all lists. */
void lmpi_field_list(lmp_field *field, uint32_t light);
void lmpi_field_unlist(lmp_field *field, uint32_t light);
void lmpi_field_relist(lmp_field *field, uint32_t light, const field_sphere *was);
void lmpi_field_unlist_all(lmp_field *field);

/* A bit per light: those listed for some of the points given. */
typedef struct field_set {
    uint64_t bits[LMP_FIELD_LIGHTS_MAX / 64];
    size_t words;
} field_set;
void lmpi_field_set_clear(const lmp_field *field, field_set *set);
void lmpi_field_set_add(const lmp_field *field, uint32_t block, field_set *set);
void lmpi_field_set_add_all(const lmp_field *field, field_set *set);
/* Returns the first light of the set from `light` on, or FIELD_NONE. */
uint32_t lmpi_field_set_next(const field_set *set, uint32_t light);

/* Returns the fraction of a light that the field does not hold at a point inside the grid. */
float lmpi_field_residual(const lmp_field *field, uint32_t light, lmp_vec3 point);

#endif
