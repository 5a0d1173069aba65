/* SPDX-License-Identifier: MIT */
/* reference_glow.h - the light of emissive meshes, from their own triangles. */
#ifndef LAMPION_TRUTH_REFERENCE_GLOW_H
#define LAMPION_TRUTH_REFERENCE_GLOW_H

#include "app/scene/scene.h"
#include "app/truth/reference_vector.h"

/* What lights a scene: its lights, with the triangles of emissive meshes in place of the lights
 * that stand for them, as long as these are at most REFERENCE_GLOW_MAX in all. A triangle's
 * radiance is its mean. */
#define REFERENCE_GLOW_MAX 20000
typedef struct reference_glow {
    const scene *world;
    size_t count;
    scene_light *lights;
    struct reference_glow_triangle *triangles; /* per light; of other lights none */
} reference_glow;

/* Returns false if memory ran out. The scene must stay in place. */
bool reference_glow_create(const scene *world, reference_glow *glow);
void reference_glow_free(reference_glow *glow);

/* Replaces the radiance of a triangle by what its material's emission map shows at a point; other
 * lights keep theirs. `user` is the reference_glow. */
void reference_glow_emission(size_t light, reference_vec point, double radiance[3], void *user);

#endif
