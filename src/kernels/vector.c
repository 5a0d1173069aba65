/* SPDX-License-Identifier: MIT */
#define LMP_LANES   4
#define LMP_KERNELS lmp_kernels_vector
#include "src/kernels/build.h"
