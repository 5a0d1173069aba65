/* SPDX-License-Identifier: MIT */
#define LMPI_LANES   4
#define LMPI_KERNELS lmpi_kernels_vector
#define LMPI_SINGLE  lmpi_single_vector
#include "src/kernels/build_tmpl.h"
