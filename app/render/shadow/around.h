/* SPDX-License-Identifier: MIT */
/* around.h - directions to an environment, drawn by what comes from them. */
#ifndef LAMPION_SHADOW_AROUND_H
#define LAMPION_SHADOW_AROUND_H

#include "app/environment/environment.h"

typedef struct shadow_around {
    const environment *source;
    double *columns; /* brightness times solid angle of a row's pixels, each with those before it */
    double *rows;    /* of whole rows in the same way; the last is all */
    double *cosines; /* with the zenith, of where rows begin and the last one ends */
    lmp_rgb mean;    /* radiance over all directions */
} shadow_around;

/* False without memory. The source must outlive it; one that does not shine makes none. */
bool shadow_around_create(const environment *source, shadow_around *around);
void shadow_around_free(shadow_around *around);

/* Whether any light comes from it. */
bool shadow_around_shines(const shadow_around *around);

/* Radiance from a direction, and the density with which shadow_around_draw draws it. */
typedef struct shadow_arrival {
    lmp_rgb radiance;
    float density;
} shadow_arrival;

/* The direction for two uniform numbers, drawn by brightness alone, and what arrives from there. */
lmp_vec3 shadow_around_draw(const shadow_around *around, float u, float v, shadow_arrival *arrival);

/* What arrives from a unit direction. */
shadow_arrival shadow_around_look(const shadow_around *around, lmp_vec3 direction);

#endif
