/* SPDX-License-Identifier: MIT */
/* gaussian.h - a light as a spherical Gaussian, which two formulas share. */
#ifndef LAMPION_SCOREBOARD_GAUSSIAN_H
#define LAMPION_SCOREBOARD_GAUSSIAN_H

#include "app/scoreboard/gltf.h"

typedef struct gaussian {
    lmp_vec3 axis;
    float sharpness, amplitude;
} gaussian;

gaussian gaussian_of_light(const formula_query *q);

/* The radiance of a white Lambert surface. */
float gaussian_diffuse(const gaussian *light, lmp_vec3 normal);

#endif
