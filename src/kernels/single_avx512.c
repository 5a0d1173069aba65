/* SPDX-License-Identifier: MIT */
#define LMP_LANES  16
#define LMP_SINGLE lmp_single_avx512
#include "src/kernels/single_build.h"
