/* SPDX-License-Identifier: MIT */
/* brdf_nodes.h - chooses the views and half angles that a preintegrated BRDF holds. */
#ifndef LAMPION_PREINTEGRATED_BRDF_NODES_H
#define LAMPION_PREINTEGRATED_BRDF_NODES_H

#include "src/preintegrated/brdf_series.h"

/* Choose the steps of the half angle, and of the view, to hold, and their number. */
lmp_result lmpi_preintegrated_brdf_caps(const brdf_series *series, float error, int *nodes,
                                        int *count);
lmp_result lmpi_preintegrated_brdf_view_nodes(const brdf_series *series, float error, int *nodes,
                                              int *count);

#endif
