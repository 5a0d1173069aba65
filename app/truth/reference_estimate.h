/* SPDX-License-Identifier: MIT */
/* reference_estimate.h - Monte Carlo estimate of the radiance that a surface reflects. */
#ifndef LAMPION_TRUTH_REFERENCE_ESTIMATE_H
#define LAMPION_TRUTH_REFERENCE_ESTIMATE_H

#include "app/truth/reference_environment.h"
#include "app/truth/reference_light.h"
#include "app/truth/reference_lobe.h"

/* Returns how far a ray goes before something opaque blocks it; INFINITY if nothing does. */
typedef double (*reference_visibility)(reference_vec point, reference_vec direction, void *user);

/* Replaces the radiance of an area, number `light` of the lights, by what it is at a point of it.
 */
typedef void (*reference_emission)(size_t light, reference_vec point, double radiance[3],
                                   void *user);

/* Adds the light that the surface reflects after other surfaces have, estimated by one sample of
 * the stream `key`. */
typedef void (*reference_indirect)(const reference_surface *surface, uint64_t key,
                                   double radiance[3], void *user);

/* The lights and the environment, as the estimator uses them; one per thread, reused for all
 * pixels. */
typedef struct reference_estimator {
    const scene_light *lights;
    size_t light_count;
    struct reference_candidate *candidates;   /* REFERENCE_SOURCES_MAX per light */
    const reference_environment *environment; /* NULL, or an environment whose power is above 0 */
    reference_visibility visibility;          /* NULL: nothing blocks light */
    void *visibility_user;
    reference_emission emission; /* NULL: areas are uniform */
    void *emission_user;
    reference_indirect indirect; /* NULL: light does not bounce */
    void *indirect_user;
} reference_estimator;

/* Prepares an estimator of these lights; returns false if memory ran out. Free with
 * reference_estimator_free. */
bool reference_estimator_create(reference_estimator *estimator, const scene_light *lights,
                                size_t count);
void reference_estimator_free(reference_estimator *estimator);

typedef struct reference_stop {
    int samples;  /* > 0: the number or, if error > 0, the most */
    double error; /* stop when the relative standard error falls below this */
    int first;    /* number of the first sample */
    int step;     /* from one sample's number to the next; 0 means 1 */
} reference_stop;

typedef struct reference_result {
    double mean[3], standard_error[3];
    int samples;
} reference_result;

/* Estimates by independent samples, numbered in the stream `key`: of the lights' solid angles, of
 * the environment's image and of the lobes, weighted by the balance heuristic over all of them
 * (Veach 1997); light from single directions is added without sampling. Unbiased. With truncated
 * lobes the result is the series' own sum, which may be negative. */
reference_result reference_estimate(const reference_estimator *estimator,
                                    const reference_surface *surface, const reference_stop *stop,
                                    uint64_t key);

/* Samples a direction as the surface reflects, from three random numbers; *weight receives what it
 * reflects from there, times the cosine, divided by the direction's density. The surface must not
 * be band-limited. */
reference_vec reference_scatter(const reference_surface *surface, const double u[3],
                                double weight[3]);

/* Returns where rays from the surface in the direction w start. */
reference_vec reference_ray_origin(const reference_surface *surface, reference_vec w);

#endif
