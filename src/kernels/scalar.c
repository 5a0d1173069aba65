/* SPDX-License-Identifier: MIT */
#define LMP_LANES   1
#define LMP_KERNELS lmp_kernels_scalar
#define LMP_SINGLE  lmp_single_scalar
#include "src/kernels/build.h"
