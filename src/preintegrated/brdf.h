/* SPDX-License-Identifier: MIT */
/* brdf.h - the memory of a preintegrated BRDF. */
#ifndef LAMPION_PREINTEGRATED_BRDF_H
#define LAMPION_PREINTEGRATED_BRDF_H

#include "src/preintegrated/reading.h"

/* Views and half angles are chosen among at most so many steps. */
#define BRDF_STEPS_MAX 1024
#define BRDF_CAP_STEPS 128
/* The most texels, because kernels count three numbers a texel in 31 bits. */
#define BRDF_TEXELS_MAX ((size_t)INT32_MAX / 3)
/* Errors are relative to a view's largest value, or to this fraction of all views' largest if that
 * is more. */
#define LMPI_PREINTEGRATED_BRDF_FLOOR 0.05

/* One allocation: this struct, then what info points to. The host stays first
 * (lmpi_release_object). */
struct lmp_preintegrated_brdf {
    lmp_host host;
    lmp_preintegrated_brdf_info info;
    float view_remap[BRDF_STEPS_MAX + 1], cap_remap[BRDF_STEPS_MAX + 1];
    lmp_rgb *ambient;
    lmp_preintegrated_brdf_slice *slices;
    int16_t *texels;
};

/* Allocates a preintegrated BRDF of the sizes in `info`: view_count, cap_count and texel_count.
 * What it points to is not yet set. */
lmp_result lmpi_preintegrated_brdf_allocate(const lmp_host *host,
                                            const lmp_preintegrated_brdf_info *info,
                                            lmp_preintegrated_brdf **brdf);

#endif
