/* SPDX-License-Identifier: MIT */
#define LMPI_LANES  1
#define LMPI_SINGLE lmpi_single_scalar
#include "src/kernels/single_build_tmpl.h"
