/* SPDX-License-Identifier: MIT */
/* source.h - what rays to the lights are drawn from: a cap of directions a light, or the image of
 * the environment. */
#ifndef LAMPION_SHADOW_SOURCE_H
#define LAMPION_SHADOW_SOURCE_H

#include "app/shadow/around.h"
#include "app/shadow/point.h"

typedef enum shadow_kind { SHADOW_SPHERE, SHADOW_POINT, SHADOW_FAR, SHADOW_AROUND } shadow_kind;

typedef struct shadow_source {
    shadow_kind kind;
    const lmp_light *light;
    lmp_rgb color;       /* radiance; intensity of a point; irradiance of a single direction */
    float brightness;    /* its mean */
    lmp_vec3 axis;       /* of what is far */
    float one_minus_cos; /* of what is far: its cap's, 0 … 2; 0: a single direction */
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

/* A direction of the source as a point sees it. */
typedef struct shadow_sample {
    lmp_vec3 direction;
    float length;    /* of the ray, to the light; INFINITY */
    float size;      /* sine of the source's angular radius */
    lmp_rgb arrives; /* radiance over the density of the direction */
} shadow_sample;
shadow_sample shadow_source_draw(const shadow_source *source, lmp_vec3 point, float u, float v);

#endif
