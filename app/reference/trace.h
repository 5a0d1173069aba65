/* SPDX-License-Identifier: MIT */
/* trace.h - rays through a scene, by Embree. */
#ifndef LAMPION_REFERENCE_TRACE_H
#define LAMPION_REFERENCE_TRACE_H

#include "app/reference/vector.h"
#include "app/scene/scene.h"

typedef struct reference_tracer reference_tracer;

/* The scene must outlive the tracer. */
bool reference_tracer_create(const scene *scene, reference_tracer **tracer, cli_error *error);
void reference_tracer_destroy(reference_tracer *tracer);

/* A point on a triangle, with interpolated attributes. */
typedef struct reference_hit {
    double distance; /* INFINITY: nothing was hit, the rest is not set */
    reference_vec position;
    reference_vec ray_origin; /* of rays to lights: off the seen face, where normals bulge it */
    reference_vec behind;     /* position, on the other side of the face */
    reference_vec normal, tangent; /* unit, normal on the side of the seen face */
    double handedness;             /* w of the tangent */
    double uv[4];                  /* two sets */
    double color[4];               /* of the vertices; 1 where the material does not heed it */
    uint32_t material;
} reference_hit;

/* What a camera sees: not the backs of single-sided triangles, nor what an alpha mask cuts out. */
reference_hit reference_tracer_see(const reference_tracer *tracer, reference_vec origin,
                                   reference_vec direction);

/* Distance at which a ray of light from a ray_origin is stopped, INFINITY if it is not: by
 * triangles of either side, but for what an alpha mask cuts out. `user` is the tracer. */
double reference_tracer_free_path(reference_vec point, reference_vec direction, void *user);

#endif
