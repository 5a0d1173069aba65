/* SPDX-License-Identifier: MIT */
#define LMPI_LANES   8
#define LMPI_KERNELS lmpi_kernels_avx2
#define LMPI_SINGLE  lmpi_single_avx2
#include "src/kernels/build_tmpl.h"
