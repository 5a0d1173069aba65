/* SPDX-License-Identifier: MIT */
/* crowd.h - random surfaces, lights and surroundings, for tests of every material. */
#ifndef LAMPION_TESTS_ORACLE_CROWD_H
#define LAMPION_TESTS_ORACLE_CROWD_H

#include <lampion/shade.h>

enum { CROWD_COUNT = 41, CROWD_LIGHTS = 5 };

typedef struct crowd {
    lmp_surface at[CROWD_COUNT];
    lmp_material material[CROWD_COUNT];
    lmp_light lights[CROWD_LIGHTS];
    float sh[3 * 36]; /* the surroundings: 6 bands, planar */
} crowd;

/* Makes a crowd of metallic-roughness without layers; every second surface has a coat's own normal.
 */
void crowd_make(crowd *c);

/* Shades surface i alone, under the lights or in the surroundings. */
lmp_rgb crowd_shade_one(const crowd *c, int i, bool environment);

/* Checks that one call shades all surfaces as each is alone, under lights and in surroundings. */
void crowd_check_many(const crowd *c);

/* Checks that methods agree under the lights: coefficients within 1e-5 of zonal sums, others within
 * `bound`. */
void crowd_check_methods(const crowd *c, double bound);

#endif
