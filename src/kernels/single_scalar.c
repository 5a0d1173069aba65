/* SPDX-License-Identifier: MIT */
#define LMP_LANES  1
#define LMP_SINGLE lmp_single_scalar
#include "src/kernels/single_build.h"
