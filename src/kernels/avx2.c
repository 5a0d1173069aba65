/* SPDX-License-Identifier: MIT */
#define LMP_LANES   8
#define LMP_KERNELS lmp_kernels_avx2
#define LMP_SINGLE  lmp_single_avx2
#include "src/kernels/build.h"
