/* SPDX-License-Identifier: MIT */
#define LMPI_LANES  4
#define LMPI_SINGLE lmpi_single_vector
#include "src/kernels/single_build_tmpl.h"
