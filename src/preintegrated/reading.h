/* SPDX-License-Identifier: MIT */
/* reading.h - the reading shared by C, the kernels' lanes and GLSL, checked against the API. */
#ifndef LAMPION_PREINTEGRATED_READING_H
#define LAMPION_PREINTEGRATED_READING_H

#include "shaders/lampion/preintegrated_lookup.h"

#include <lampion/preintegrated.h>

#include <assert.h>

#define LMPI_PREINTEGRATED_PI 3.14159265358979323846

static_assert(LMP_LOOKUP_REMAP_COUNT == LMP_PREINTEGRATED_LOBE_REMAP_COUNT &&
                  (int)LMP_LOOKUP_EXPONENT_MAX == (int)LMP_PREINTEGRATED_LOBE_EXPONENT_MAX,
              "the remap is what the API says");

#endif
