/* SPDX-License-Identifier: MIT */
#define LMPI_LANES  8
#define LMPI_SINGLE lmpi_single_avx2
#include "src/kernels/single_build_tmpl.h"
