/* SPDX-License-Identifier: MIT */
/* transfer_surfels.h - samples of a scene's surfaces, spread evenly over their area. */
#ifndef LAMPION_RENDER_SHADOW_TRANSFER_SURFELS_H
#define LAMPION_RENDER_SHADOW_TRANSFER_SURFELS_H

#include "app/scene/scene.h"

#include <lampion/transfer.h>

typedef struct transfer_surfels {
    lmp_transfer_surfel *at;
    size_t count;
    float spacing; /* the root of the area that each stands for */
} transfer_surfels;

/* Points on a surface read the surfels up to this many spacings away. */
#define TRANSFER_REACH 2.1f

/* Makes the surfels of a scene: TRANSFER_SPACINGS of them span its extent, fewer where this would
 * be more than TRANSFER_SURFELS_MAX; double-sided surfaces have them on both sides. Without a
 * surface there is none. `albedos` may be NULL; of a material whose color there is not below 0 it
 * is the albedo, in place of its own. Returns false if memory ran out; free surfels->at in any
 * case. */
#define TRANSFER_SURFELS_MAX 40000
#define TRANSFER_SPACINGS    60
bool transfer_surfels_make(const scene *world, const lmp_rgb *albedos, transfer_surfels *surfels);

/* Writes number k of Roberts' sequence R2, whose fractions fill the square evenly, shifted by
 * `shift` so that surfels do not share a pattern. */
void transfer_sequence(double k, double shift, double xy[2]);

/* Finds the weights of the corners for point k of a triangle: the sequence, folded into it. */
void transfer_weights(size_t k, float weights[3]);

/* Finds the unit normal of a triangle's face; returns its area. */
float transfer_face(float corners[3][3], lmp_vec3 *normal);

#endif
