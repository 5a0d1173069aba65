/* SPDX-License-Identifier: MIT */
#define LMPI_LANES   1
#define LMPI_KERNELS lmpi_kernels_scalar
#define LMPI_SINGLE  lmpi_single_scalar
#include "src/kernels/build_tmpl.h"
