/* SPDX-License-Identifier: MIT */
/* splats.h - Gaussian splats on a knotted tube, which the page lights anew in every frame. */
#ifndef LAMPION_WEB_SPLATS_H
#define LAMPION_WEB_SPLATS_H

#include "lampion/shade.h"

#define SPLATS_COUNT 6000

/* A flat Gaussian, as shaders read it: its standard deviations are the lengths of two axes. */
typedef struct splats_splat {
    float center[3], normal[3], along[3], across[3], albedo[3], color[3];
} splats_splat;

/* Places SPLATS_COUNT splats around the ball of builtin:ball. */
void splats_place(splats_splat *splats);

/* Computes the color of each splat as SplatLights of the npm package does with normals: the light
 * that a matte surface of its albedo reflects. */
void splats_light(splats_splat *splats, const lmp_shade_settings *settings, const lmp_light *lights,
                  size_t light_count);

#endif
