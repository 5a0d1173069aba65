/* SPDX-License-Identifier: MIT */
/* reference_path.h - light that bounces: paths from surface to surface, each of which is lit
 * directly (path tracing with next-event estimation; J. Kajiya, The rendering equation, 1986). */
#ifndef LAMPION_TRUTH_REFERENCE_PATH_H
#define LAMPION_TRUTH_REFERENCE_PATH_H

#include "app/truth/reference_describe.h"
#include "app/truth/reference_estimate.h"

/* What paths need; one per thread. */
typedef struct reference_path {
    const reference_materials *materials;
    const reference_tracer *tracer;
    int bounces;                   /* surfaces of a path, besides the one where it begins */
    reference_estimator estimator; /* of the direct light of each */
    reference_description met;     /* the surface that the path has reached */
} reference_path;

/* Adds the light that `from` reflects after other surfaces have reflected it, estimated by one
 * path: a reference_indirect, whose `user` is the reference_path. Surfaces emit nothing here,
 * because what they emit is direct light; the backs of single-sided triangles are black. */
void reference_path_sample(const reference_surface *from, uint64_t key, double radiance[3],
                           void *user);

#endif
