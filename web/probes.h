/* SPDX-License-Identifier: MIT */
/* probes.h - a grid of light probes over a scene, which the page relights in every frame. */
#ifndef LAMPION_WEB_PROBES_H
#define LAMPION_WEB_PROBES_H

#include "lampion/light.h"

#include <stdint.h>

/* The grid, as shaders read it: texels are those of a 3D texture, laid out as web/package/probes.js
 * says. The first and last probes along an axis are at the box's faces. */
typedef struct probes_grid {
    float minimum[3], extent[3];
    uint32_t size[3];
    float *texels;
    lmp_vec3 *points;
    float *sh;
} probes_grid;

/* Spreads probes over a box, as evenly along the three axes as their number allows; frees those
 * before. Returns false without memory. */
bool probes_spread(probes_grid *grid, const float minimum[3], const float maximum[3]);

/* Computes the irradiance at all probes under lights of any kinds. */
void probes_light(probes_grid *grid, const lmp_light *lights, size_t count);

#endif
