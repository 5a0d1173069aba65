/* SPDX-License-Identifier: MIT */
/* reference_trace.h - rays through a scene, by Embree. */
#ifndef LAMPION_TRUTH_REFERENCE_TRACE_H
#define LAMPION_TRUTH_REFERENCE_TRACE_H

#include "app/scene/scene.h"
#include "app/truth/reference_vector.h"

typedef struct reference_tracer reference_tracer;

/* Makes a tracer of a scene, which must outlive it. */
bool reference_tracer_create(const scene *scene, reference_tracer **tracer, base_error *error);
void reference_tracer_destroy(reference_tracer *tracer);

/* A point on a triangle, with interpolated attributes. */
typedef struct reference_hit {
    double distance; /* INFINITY if nothing was hit; the rest is then not set */
    reference_vec position;
    reference_vec ray_origin; /* of rays to lights: off the visible face, where normals bulge it */
    reference_vec ray_behind; /* of rays to lights on the other side */
    reference_vec behind;     /* the position, on the other side of the face */
    reference_vec normal, tangent; /* unit; normal on the side of the visible face */
    double handedness;             /* w of the tangent */
    double uv[4];                  /* two sets */
    double color[4];               /* vertex color; 1 if the material does not use it */
    uint32_t material;
} reference_hit;

/* Traces a camera ray, which ignores backs of single-sided triangles and what an alpha mask cuts
 * out. */
reference_hit reference_tracer_see(const reference_tracer *tracer, reference_vec origin,
                                   reference_vec direction);

/* Traces a ray of bounced light, which the same triangles block as light rays. The back of a
 * single-sided triangle reflects nothing, so it is no hit. */
reference_hit reference_tracer_meet(const reference_tracer *tracer, reference_vec origin,
                                    reference_vec direction);

/* Returns the distance at which a light ray from a ray_origin is blocked by either side of a
 * triangle, except where an alpha mask cuts it out; INFINITY if it is not. `user` is the tracer. */
double reference_tracer_free_path(reference_vec point, reference_vec direction, void *user);

#endif
