/* SPDX-License-Identifier: MIT */
/* update.h - updates a field when its lights change. */
#ifndef LAMPION_FIELD_UPDATE_H
#define LAMPION_FIELD_UPDATE_H

#include "src/field/grid.h"

/* Appends a light and lists it. */
void lmpi_field_push_light(lmp_field *field, const lmp_light *light);

#endif
