/* SPDX-License-Identifier: MIT */
/* around.h - directions to an environment, sampled by their brightness. */
#ifndef LAMPION_RENDER_SHADOW_AROUND_H
#define LAMPION_RENDER_SHADOW_AROUND_H

#include "app/scene/environment.h"

typedef struct shadow_around {
    const environment *source;
    double *columns; /* cumulative brightness times solid angle of each row's pixels */
    double *rows;    /* cumulative sums of whole rows; the last is the total */
    double *cosines; /* of the zenith angles of the rows' edges */
    lmp_rgb mean;    /* radiance over all directions */
} shadow_around;

/* Prepares sampling of an environment, which must outlive it; one that does not shine gives no
 * samples. Returns false if memory ran out. */
bool shadow_around_create(const environment *source, shadow_around *around);
void shadow_around_free(shadow_around *around);

/* Whether any light comes from the environment. */
bool shadow_around_shines(const shadow_around *around);

/* Radiance from a direction, and the density with which it is sampled. */
typedef struct shadow_arrival {
    lmp_rgb radiance;
    float density;
} shadow_arrival;

/* Samples a direction by brightness alone, from two uniform numbers; *arrival is its radiance and
 * density. */
lmp_vec3 shadow_around_draw(const shadow_around *around, float u, float v, shadow_arrival *arrival);

/* Returns the radiance and density of a unit direction. */
shadow_arrival shadow_around_look(const shadow_around *around, lmp_vec3 direction);

#endif
