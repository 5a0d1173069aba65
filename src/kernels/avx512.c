/* SPDX-License-Identifier: MIT */
#define LMPI_LANES   16
#define LMPI_KERNELS lmpi_kernels_avx512
#define LMPI_SINGLE  lmpi_single_avx512
#include "src/kernels/build_tmpl.h"
