/* SPDX-License-Identifier: MIT */
#define LMP_LANES   4
#define LMP_KERNELS lmp_kernels_vector
#define LMP_SINGLE  lmp_single_vector
#include "src/kernels/build.h"
