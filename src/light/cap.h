/* SPDX-License-Identifier: MIT */
/* cap.h - what every light reduces to, seen from a point. */
#ifndef LAMPION_LIGHT_CAP_H
#define LAMPION_LIGHT_CAP_H

#include "src/kernels/horizon.h"
#include "src/kernels/packed_light.h"
#include "src/sphere/sphere.h"

#include <lampion/light.h>

/* Adds the coefficients of bands low … high-1 to each of the planes red, green, blue that is not
 * NULL; a plane holds only those bands. */
void lmpi_cap_add(int low, int high, const lmp_cap *cap, float *const planes[3]);

/* Adds the irradiance on a surface that faces `normal`. */
static inline void lmpi_cap_add_irradiance(const lmp_cap *cap, lmp_vec3 normal, lmp_rgb *sum) {
    const lmp_vec3 w = cap->axis;
    const float cosine = normal.x * w.x + normal.y * w.y + normal.z * w.z;
    const float clipped = lmpi_horizon_cosine(cosine, cap->one_minus_cos), pi = 3.14159265f;
    sum->r += cap->strength.r * clipped + pi * cap->ambient.r;
    sum->g += cap->strength.g * clipped + pi * cap->ambient.g;
    sum->b += cap->strength.b * clipped + pi * cap->ambient.b;
}

#endif
