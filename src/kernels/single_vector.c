/* SPDX-License-Identifier: MIT */
#define LMP_LANES  4
#define LMP_SINGLE lmp_single_vector
#include "src/kernels/single_build.h"
