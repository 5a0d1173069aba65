/* SPDX-License-Identifier: MIT */
/* shade.h - small, large, ambient and distant lights, for the tables that the kernels read. */
#ifndef LAMPION_FUZZ_SHADE_H
#define LAMPION_FUZZ_SHADE_H

#include <lampion/shade.h>

enum { FUZZ_LIGHTS = 4 };

static const lmp_light fuzz_lights[FUZZ_LIGHTS] = {
    { .position = { 0, 0, 1 }, .radius = 1e-3f, .radiance = { 1, 1, 1 } },
    { .position = { 0.7f, 0.1f, -0.5f }, .radius = 0.5f, .radiance = { 1, 1, 1 } },
    { .position = { 0.1f, 0, 0 }, .radius = 2, .radiance = { 1, 1, 1 } },
    { .position = { 1e6f, 1, 0 }, .radius = 1, .radiance = { 1, 1, 1 } },
};

#endif
