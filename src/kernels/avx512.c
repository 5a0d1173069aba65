/* SPDX-License-Identifier: MIT */
#define LMP_LANES   16
#define LMP_KERNELS lmp_kernels_avx512
#define LMP_SINGLE  lmp_single_avx512
#include "src/kernels/build.h"
