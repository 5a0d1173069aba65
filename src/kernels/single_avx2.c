/* SPDX-License-Identifier: MIT */
#define LMP_LANES  8
#define LMP_SINGLE lmp_single_avx2
#include "src/kernels/single_build.h"
