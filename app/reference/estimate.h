/* SPDX-License-Identifier: MIT */
/* estimate.h - Monte-Carlo estimate of the radiance that a surface reflects. */
#ifndef LAMPION_REFERENCE_ESTIMATE_H
#define LAMPION_REFERENCE_ESTIMATE_H

#include "app/reference/environment.h"
#include "app/reference/light.h"
#include "app/reference/lobe.h"

/* How far a ray goes before something opaque stops it; INFINITY if nothing does. */
typedef double (*reference_visibility)(reference_vec point, reference_vec direction, void *user);

/* What the surface and the lights are to the estimator; one a thread, reused from pixel to pixel.
 */
typedef struct reference_estimator {
    const scene_light *lights;
    size_t light_count;
    struct reference_candidate *candidates;   /* REFERENCE_SOURCES_MAX a light */
    const reference_environment *environment; /* or NULL; its power is above 0 */
    reference_visibility visibility;          /* NULL: nothing hides a light */
    void *visibility_user;
} reference_estimator;

/* False without memory. Free with reference_estimator_free. */
bool reference_estimator_create(reference_estimator *estimator, const scene_light *lights,
                                size_t count);
void reference_estimator_free(reference_estimator *estimator);

typedef struct reference_stop {
    int samples;  /* > 0: as many, or at most as many if error > 0 */
    double error; /* stop when the standard error falls below this part of the mean */
    int first;    /* number of the first sample */
    int step;     /* from a sample's number to the next one's; 0 means 1 */
} reference_stop;

typedef struct reference_result {
    double mean[3], standard_error[3];
    int samples;
} reference_result;

/* Independent samples, numbered from the stream `key`: of the lights' solid angles, of the image of
 * the environment and of the lobes, weighted by the balance heuristic over all of them (Veach
 * 1997); what lights of a single direction give is added without sampling. Unbiased. Of truncated
 * lobes the sum is the series' own: it may be negative. */
reference_result reference_estimate(const reference_estimator *estimator,
                                    const reference_surface *surface, const reference_stop *stop,
                                    uint64_t key);

#endif
