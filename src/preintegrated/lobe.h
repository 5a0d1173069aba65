/* SPDX-License-Identifier: MIT */
/* lobe.h - makes a preintegrated lobe: plan, allocate, then fill. */
#ifndef LAMPION_PREINTEGRATED_LOBE_H
#define LAMPION_PREINTEGRATED_LOBE_H

#include "src/preintegrated/lobe_data.h"

/* Whether bands, window, window_size and error are in their ranges. */
bool lmpi_preintegrated_lobe_valid(const lmp_preintegrated_lobe_info *info);

/* Allocates a lobe like the plan; its coefficients are not yet set. */
lmp_result lmpi_preintegrated_lobe_allocate(const lmp_host *host,
                                            const lmp_preintegrated_lobe *plan,
                                            lmp_preintegrated_lobe **lobe);

#endif
