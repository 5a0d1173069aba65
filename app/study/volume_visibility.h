/* SPDX-License-Identifier: MIT */
/* volume_visibility.h - how much of a scene's lights its surfaces block at a point in space. */
#ifndef LAMPION_STUDY_VOLUME_VISIBILITY_H
#define LAMPION_STUDY_VOLUME_VISIBILITY_H

#include "app/scene/environment.h"
#include "app/scene/trace/trace.h"

typedef struct volume_visibility volume_visibility;

/* Prepares visibility by so many rays to each light. The scene and its tree must outlive it.
 * Returns NULL if memory ran out. */
volume_visibility *volume_visibility_create(const scene *scene, const trace_bvh *bvh,
                                            const environment *surroundings, int rays);
void volume_visibility_destroy(volume_visibility *visibility);

/* Copies the lights, each dimmed by the fraction that arrives at a point; returns the fraction of
 * the environment that arrives. May be called from any thread. */
float volume_visible_lights(const volume_visibility *visibility, lmp_vec3 point, lmp_light *seen);

#endif
