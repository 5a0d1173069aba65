/* SPDX-License-Identifier: MIT */
/* visibility.h - what the surfaces of a scene hide of its lights from a point that is on none. */
#ifndef LAMPION_VOLUME_VISIBILITY_H
#define LAMPION_VOLUME_VISIBILITY_H

#include "app/environment/environment.h"

typedef struct volume_visibility volume_visibility;

/* By so many rays to each light. The scene must outlive it. NULL without memory. */
volume_visibility *volume_visibility_create(const scene *scene, const environment *surroundings,
                                            int rays);
void volume_visibility_destroy(volume_visibility *visibility);

/* The lights as they are seen from a point: each dimmed to the fraction of it that arrives. Returns
 * the fraction of the environment that does. From any thread. */
float volume_visible_lights(const volume_visibility *visibility, lmp_vec3 point, lmp_light *seen);

#endif
