/* SPDX-License-Identifier: MIT */
/* ssim.h - structural similarity of two images' luminance. */
#ifndef LAMPION_IMAGE_SSIM_H
#define LAMPION_IMAGE_SSIM_H

#include "app/image/image.h"

/* Computes SSIM (Wang et al. 2004) with their constants: Gaussian windows of 11 pixels and sigma
 * 1.5, truncated at the image's edges, K = 0.01 and 0.03. Returns false if memory ran out. */
bool compare_ssim(const image *candidate, const image *reference, double peak, double *ssim);

#endif
