/* SPDX-License-Identifier: MIT */
/* field.h - creates fields. */
#ifndef LAMPION_FIELD_FIELD_H
#define LAMPION_FIELD_FIELD_H

#include "src/field/grid.h"

/* Fills in every default of a desc; returns false if a member is outside its range. */
bool lmpi_field_resolve(lmp_field_desc *desc);

/* Allocates a field without lights. desc must be resolved. */
lmp_result lmpi_field_allocate(const lmp_host *host, const lmp_field_desc *desc, lmp_field **field);

#endif
