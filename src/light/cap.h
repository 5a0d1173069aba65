/* SPDX-License-Identifier: MIT */
/* cap.h - the geometry every light reduces to, and the polynomials of a cap. */
#ifndef LAMPION_LIGHT_CAP_H
#define LAMPION_LIGHT_CAP_H

#include "src/base/precondition.h"
#include "src/base/tables.h"
#include "src/base/unroll.h"
#include "src/kernels/horizon.h"
#include "src/kernels/kernels.h"

#include <lampion/light.h>

/* A sphere from a point. Outside sin²a = r²/d², inside d²/r². */
typedef struct lmp_sight {
    lmp_vec3 axis; /* to the center; z if d = 0 */
    float distance;
    bool inside;
    float sin2, cosine, one_minus_cos; /* sin²a, |cos a|, 1 - |cos a| */
} lmp_sight;

void lmp_sight_distance(float radius, float distance, lmp_sight *sight);
void lmp_sight_sphere(lmp_vec3 center, float radius, lmp_vec3 point, lmp_sight *sight);

/* A length, and a point, whose squares are still float32. */
static inline bool lmp_is_length(float x) {
    return x >= 0 && x <= LMP_LENGTH_MAX;
}
static inline bool lmp_is_point(lmp_vec3 p) {
    return lmp_is_length(fabsf(p.x)) && lmp_is_length(fabsf(p.y)) && lmp_is_length(fabsf(p.z));
}

static inline bool lmp_are_spheres(const lmp_spheres *spheres, size_t count) {
    return lmp_are_finite(spheres->center, count) &&
           lmp_are_within(spheres->radius, count, 0, LMP_LENGTH_MAX);
}

/* Whether the members that the light's kind names are in their ranges (light.h). */
bool lmp_is_light(const lmp_light *light);
bool lmp_are_lights(const lmp_light *lights, size_t count);

/* Adds the coefficients of bands low … high-1, as many values, to each of the planes, red, green,
 * blue, that is not NULL. */
void lmp_cap_add(int low, int high, const lmp_cap *cap, float *const planes[3]);

/* Adds the irradiance of a surface that faces `normal`. */
static inline void lmp_cap_add_irradiance(const lmp_cap *cap, lmp_vec3 normal, lmp_rgb *sum) {
    const lmp_vec3 w = cap->axis;
    const float cosine = normal.x * w.x + normal.y * w.y + normal.z * w.z;
    const float clipped = lmp_horizon_cosine(cosine, cap->one_minus_cos), pi = 3.14159265f;
    sum->r += cap->strength.r * clipped + pi * cap->ambient.r;
    sum->g += cap->strength.g * clipped + pi * cap->ambient.g;
    sum->b += cap->strength.b * clipped + pi * cap->ambient.b;
}

/* R_l(1 - one_minus_cos), l < bands, one_minus_cos in 0 … 1, by differences: cos a itself, rounded
 * near 1, would cost l² units. */
LMP_INLINE void lmp_cap_polynomials(int bands, float one_minus_cos, float *r) {
    r[0] = 2 / (2 - one_minus_cos);
    float difference = 0, now = 1;
    for (int l = 1; l < bands; l++) {
        difference = lmp_table_cap_d[l] * difference - lmp_table_cap_t[l] * (one_minus_cos * now);
        now += difference;
        r[l] = now;
    }
}

/* P_l(1 - one_minus_cos) in the same way. */
static inline void lmp_legendre_polynomials(int bands, float one_minus_cos, float *p) {
    float difference = 0, now = 1;
    p[0] = now;
    for (int l = 1; l < bands; l++) {
        difference =
            lmp_table_legendre_d[l] * difference - lmp_table_legendre_t[l] * (one_minus_cos * now);
        now += difference;
        p[l] = now;
    }
}

#endif
