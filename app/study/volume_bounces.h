/* SPDX-License-Identifier: MIT */
/* volume_bounces.h - the light that a scene's surfaces reflect to probes, by the surfels of its
 * transfer (docs/transfer.md). */
#ifndef LAMPION_STUDY_VOLUME_BOUNCES_H
#define LAMPION_STUDY_VOLUME_BOUNCES_H

#include "app/scene/environment.h"
#include "app/scene/trace/trace.h"

typedef struct volume_bounces volume_bounces;

/* Lights the surfaces of a scene and lets light bounce so often, at least once, the last time to
 * the probes. Surfaces hide lights from each other if `shadows`. The scene and its tree must
 * outlive the result, which is NULL if memory ran out. */
volume_bounces *volume_bounces_create(const scene *world, const trace_bvh *bvh,
                                      const environment *around, bool shadows, int count);
void volume_bounces_destroy(volume_bounces *bounces);

/* Adds the coefficients of what surfaces reflect to a point, in three planes of up to
 * LMP_FIELD_BANDS_MAX bands. May be called from any thread. */
void volume_bounces_add(const volume_bounces *bounces, lmp_vec3 point, int bands, float *sh);

#endif
