/* SPDX-License-Identifier: MIT */
/* sphere.h - the geometry of a sphere seen from a point, and the polynomials of a cap. */
#ifndef LAMPION_SPHERE_SPHERE_H
#define LAMPION_SPHERE_SPHERE_H

#include "src/base/precondition.h"
#include "src/base/tables.h"
#include "src/base/unroll.h"

#include <lampion/sphere.h>

/* The cap that a sphere subtends at a point: sin²a is r²/d² outside it, d²/r² inside. */
typedef struct lmpi_subtended_cap {
    lmp_vec3 axis; /* to the center; z if d = 0 */
    float distance;
    bool inside;
    float sin2, cosine, one_minus_cos; /* sin²a, |cos a|, 1 - |cos a| */
} lmpi_subtended_cap;

void lmpi_subtended_at_distance(float radius, float distance, lmpi_subtended_cap *subtended);
void lmpi_subtended_by_sphere(lmp_vec3 center, float radius, lmp_vec3 point,
                              lmpi_subtended_cap *subtended);

/* Whether a length, or a point's coordinates, have squares that are finite as float32. */
static inline bool lmpi_is_length(float x) {
    return x >= 0 && x <= LMP_LENGTH_MAX;
}
static inline bool lmpi_is_point(lmp_vec3 p) {
    return lmpi_is_length(fabsf(p.x)) && lmpi_is_length(fabsf(p.y)) && lmpi_is_length(fabsf(p.z));
}

static inline bool lmpi_are_spheres(const lmp_spheres *spheres, size_t count) {
    return lmpi_are_finite(spheres->center, count) &&
           lmpi_are_within(spheres->radius, count, 0, LMP_LENGTH_MAX);
}

/* Computes R_l(1 - one_minus_cos) for l < bands, one_minus_cos in 0 … 1, by differences: cos a
 * itself, rounded near 1, would cost l² units. */
LMPI_INLINE void lmpi_cap_polynomials(int bands, float one_minus_cos, float *r) {
    r[0] = 2 / (2 - one_minus_cos);
    float difference = 0, now = 1;
    for (int l = 1; l < bands; l++) {
        difference = lmpi_table_cap_d[l] * difference - lmpi_table_cap_t[l] * (one_minus_cos * now);
        now += difference;
        r[l] = now;
    }
}

/* Computes P_l(1 - one_minus_cos) by differences, as lmpi_cap_polynomials does R_l. */
static inline void lmpi_legendre_polynomials(int bands, float one_minus_cos, float *p) {
    float difference = 0, now = 1;
    p[0] = now;
    for (int l = 1; l < bands; l++) {
        difference = lmpi_table_legendre_d[l] * difference -
                     lmpi_table_legendre_t[l] * (one_minus_cos * now);
        now += difference;
        p[l] = now;
    }
}

#endif
