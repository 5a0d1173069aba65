/* SPDX-License-Identifier: MIT */
/* scoreboard_gaussian.h - a light as a spherical Gaussian, which two formulas share. */
#ifndef LAMPION_TRUTH_SCOREBOARD_GAUSSIAN_H
#define LAMPION_TRUTH_SCOREBOARD_GAUSSIAN_H

#include "app/truth/scoreboard_gltf.h"

typedef struct gaussian {
    lmp_vec3 axis;
    float sharpness, amplitude;
} gaussian;

gaussian gaussian_of_light(const formula_query *q);

/* Returns the radiance of a white Lambert surface. */
float gaussian_diffuse(const gaussian *light, lmp_vec3 normal);

#endif
