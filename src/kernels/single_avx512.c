/* SPDX-License-Identifier: MIT */
#define LMPI_LANES  16
#define LMPI_SINGLE lmpi_single_avx512
#include "src/kernels/single_build_tmpl.h"
