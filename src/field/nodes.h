/* SPDX-License-Identifier: MIT */
/* nodes.h - computes the nodes of a field. */
#ifndef LAMPION_FIELD_NODES_H
#define LAMPION_FIELD_NODES_H

#include "src/field/grid.h"

/* Sets the state of every brick, of coarser fields too. */
void lmpi_field_set_states(lmp_field *field, unsigned char state);

/* Adds what the spheres give to the nodes that are computed; negative radiance takes light away. */
void lmpi_field_add_spheres(const lmp_host *host, lmp_field *field, const field_sphere *spheres,
                            size_t count);

/* Recomputes one brick, if it has been computed, of this field and of each coarser one. */
void lmpi_field_refresh(lmp_field *field, uint64_t turn);

#endif
