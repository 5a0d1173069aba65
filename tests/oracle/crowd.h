/* SPDX-License-Identifier: MIT */
/* Random surfaces, lights and surroundings, for what holds of every material. */
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

/* Metallic-roughness everywhere, without layers; every second surface has a coat's own normal. */
void crowd_make(crowd *c);

/* The i-th surface alone, under the lights or in the surroundings. */
lmp_rgb crowd_shade_one(const crowd *c, int i, bool environment);

/* All of them by one call are what each is alone, under lights and in surroundings. */
void crowd_check_many(const crowd *c);

/* Methods shade each alike under the lights: coefficients within 1e-5 of zonal sums, others
 * within `bound`. */
void crowd_check_methods(const crowd *c, double bound);

#endif
