/* SPDX-License-Identifier: MIT */
/* environment.h - ambient light from far away, in double: the image itself, pixel by pixel. */
#ifndef LAMPION_REFERENCE_ENVIRONMENT_H
#define LAMPION_REFERENCE_ENVIRONMENT_H

#include "app/environment/environment.h"
#include "app/reference/vector.h"

/* An image of one radiance a pixel, from which directions are drawn by what comes from them. */
typedef struct reference_environment {
    const environment *source;
    double *cumulative; /* of the power of the pixels, row by row; the last is the whole */
    double mean[3];     /* radiance over all directions */
} reference_environment;

/* False without memory. The source must outlive it; one that does not shine makes none. */
bool reference_environment_create(const environment *source, reference_environment *e);
void reference_environment_free(reference_environment *e);

/* Whether any light comes from it. */
bool reference_environment_shines(const reference_environment *e);

/* A direction for two uniform numbers, by the density that reference_environment_at tells. */
reference_vec reference_environment_draw(const reference_environment *e, double u, double v);

/* Adds the radiance that comes from the unit direction w; returns its density, per steradian. */
double reference_environment_at(const reference_environment *e, reference_vec w,
                                double radiance[3]);

#endif
