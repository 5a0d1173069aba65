/* SPDX-License-Identifier: MIT */
/* reference_environment.h - the environment in double: the image itself, pixel by pixel. */
#ifndef LAMPION_TRUTH_REFERENCE_ENVIRONMENT_H
#define LAMPION_TRUTH_REFERENCE_ENVIRONMENT_H

#include "app/scene/environment.h"
#include "app/truth/reference_vector.h"

/* An image with one radiance per pixel, from which directions are sampled in proportion to their
 * light. */
typedef struct reference_environment {
    const environment *source;
    double *cumulative; /* cumulative power of the pixels, row by row; the last is the total */
    double mean[3];     /* radiance over all directions */
} reference_environment;

/* Prepares sampling of an environment, which must outlive it; one that does not shine gives no
 * samples. Returns false if memory ran out. */
bool reference_environment_create(const environment *source, reference_environment *e);
void reference_environment_free(reference_environment *e);

/* Whether any light comes from the environment. */
bool reference_environment_shines(const reference_environment *e);

/* Samples a direction from two uniform numbers, with the density that reference_environment_at
 * returns. */
reference_vec reference_environment_draw(const reference_environment *e, double u, double v);

/* Adds the radiance that comes from the unit direction w; returns the direction's density, per
 * steradian. */
double reference_environment_at(const reference_environment *e, reference_vec w,
                                double radiance[3]);

#endif
