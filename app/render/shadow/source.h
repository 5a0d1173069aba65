/* SPDX-License-Identifier: MIT */
/* source.h - what rays to the lights are drawn from: a cap of directions a light, or the image of
 * the environment. */
#ifndef LAMPION_SHADOW_SOURCE_H
#define LAMPION_SHADOW_SOURCE_H

#include "app/render/shadow/around.h"
#include "app/render/shadow/point.h"

#include "src/light/packed.h"

typedef enum shadow_kind { SHADOW_SPHERE, SHADOW_POINT, SHADOW_FAR, SHADOW_AROUND } shadow_kind;

typedef struct shadow_source {
    shadow_kind kind;
    lmp_packed_light light; /* of what is near */
    lmp_rgb color;          /* radiance; intensity of a point; irradiance of a single direction */
    float brightness;       /* its mean */
    lmp_vec3 axis;          /* of what is far */
    float one_minus_cos;    /* of what is far: its cap's, 0 … 2; 0: a single direction */
    const shadow_around *around;
} shadow_source;

/* The sources of the lights and of the environment, which may be NULL; returns how many of
 * SHADOW_SOURCES(count) there are. */
#define SHADOW_SOURCES(count) (2 * (count) + 1)
size_t shadow_sources_make(const scene_light *lights, size_t count, const shadow_around *around,
                           shadow_source *sources);

/* About what the points reflect of every source where nothing hides it, above 0 where it is: each
 * with those before it. */
void shadow_sources_weigh(const shadow_source *sources, size_t count, const shadow_points *points,
                          shadow_lanes *sums);

/* Directions of sources as points see them, beside each other. */
typedef struct shadow_samples {
    shadow_vectors direction;
    shadow_lanes length;    /* of the ray, to the light; INFINITY */
    shadow_lanes size;      /* sine of the source's angular radius */
    shadow_vectors arrives; /* radiance over the density of the direction */
} shadow_samples;

/* One for each of the positions, of the source that stands there, by the uniform numbers u and v.
 * Where they are those of `points`, which may be NULL, directions to the environment are drawn by
 * what these reflect as well as by what shines. */
void shadow_sources_draw(const shadow_source *const sources[SHADOW_LANES],
                         const shadow_vectors *positions, const shadow_points *points,
                         const shadow_lanes u, const shadow_lanes v, shadow_samples *samples);

#endif
