/* SPDX-License-Identifier: MIT */
/* kinds.h - one light of each kind, all equally bright, for a scene some units wide around the
 * origin: caps on both sides of pi/2, and a spot whose cone ends within the scene. */
#ifndef TESTS_KINDS_H
#define TESTS_KINDS_H

#include <lampion/light.h>

enum { KINDS = 7 };

static const lmp_light one_of_each_kind[KINDS] = {
    { .kind = LMP_LIGHT_SPHERE,
      .position = { 1, 4, 2 },
      .radius = 0.5f,
      .radiance = { 30, 20, 10 } },
    { .kind = LMP_LIGHT_POINT, .position = { -2, 3, 1 }, .intensity = { 8, 12, 16 } },
    { .kind = LMP_LIGHT_SPOT,
      .position = { 0, 4, 3 },
      .direction = { 0, -0.8f, -0.6f },
      .inner = 0.1f,
      .outer = 0.5f,
      .intensity = { 60, 30, 15 } },
    { .kind = LMP_LIGHT_DIRECTIONAL, .direction = { 0.6f, 0.8f, 0 }, .irradiance = { 1, 2, 3 } },
    { .kind = LMP_LIGHT_CAP,
      .direction = { 0, 0.8f, 0.6f },
      .angle = 0.3f,
      .radiance = { 6, 4, 2 } },
    { .kind = LMP_LIGHT_CAP,
      .direction = { -0.6f, 0.8f, 0 },
      .angle = 2.5f,
      .radiance = { 0.2f, 0.4f, 0.3f } },
    { .kind = LMP_LIGHT_HEMISPHERE,
      .direction = { 0, 1, 0 },
      .radiance = { 0.3f, 0.5f, 0.9f },
      .ground = { 0.2f, 0.1f, 0.05f } },
};

#endif
