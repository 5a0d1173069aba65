/* SPDX-License-Identifier: MIT */
/* source.h - the sources that rays are sampled from: one or two caps of directions per light, and
 * the image of the environment. */
#ifndef LAMPION_RENDER_SHADOW_SOURCE_H
#define LAMPION_RENDER_SHADOW_SOURCE_H

#include "app/render/shadow/around.h"
#include "app/render/shadow/point.h"
#include "app/scene/emitter.h"

#include "src/light/packed.h"

typedef enum shadow_kind {
    SHADOW_SPHERE,
    SHADOW_POINT,
    SHADOW_AREA,
    SHADOW_FAR,
    SHADOW_AROUND
} shadow_kind;

typedef struct shadow_source {
    shadow_kind kind;
    lmpi_packed_light light;   /* of a near source */
    const scene_emitter *area; /* of an area */
    lmp_rgb color;    /* radiance of a cap or an area; intensity of a point; irradiance of a single
                         direction */
    float brightness; /* mean of the color */
    lmp_vec3 axis;    /* of a far source */
    float one_minus_cos; /* of a far source's cap, 0 … 2; 0: a single direction */
    const shadow_around *around;
} shadow_source;

/* Makes the sources of the lights and of the environment, which may be NULL; returns how many of
 * SHADOW_SOURCES(count) there are. `areas` has room for as many areas as there are lights, and must
 * outlive the sources. */
#define SHADOW_SOURCES(count) (2 * (count) + 1)
size_t shadow_sources_make(const scene_light *lights, size_t count, const shadow_around *around,
                           scene_emitter *areas, shadow_source *sources);

/* Estimates what each point reflects of every unblocked source, above 0 wherever there is any;
 * weights are cumulative over the sources. */
void shadow_sources_weigh(const shadow_source *sources, size_t count, const shadow_points *points,
                          shadow_lanes *sums);

/* Sampled directions to sources, side by side. */
typedef struct shadow_samples {
    shadow_vectors direction;
    shadow_lanes length;    /* of the ray to the light; INFINITY for a far one */
    shadow_lanes size;      /* sine of the source's angular radius */
    shadow_vectors arrives; /* radiance divided by the direction's density */
} shadow_samples;

/* Samples one direction per position, to that lane's source, from the uniform numbers u and v. If
 * the positions are those of `points`, which may be NULL, directions to the environment are sampled
 * by what the points reflect as well as by brightness. */
void shadow_sources_draw(const shadow_source *const sources[SHADOW_LANES],
                         const shadow_vectors *positions, const shadow_points *points,
                         const shadow_lanes u, const shadow_lanes v, shadow_samples *samples);

/* Lets a lane's ray, which was sampled for a position, end at the sampled point of an area: it
 * starts off the surface, from where what faces it is nearer, and would end beyond the triangle
 * that the area may be. */
void shadow_end_at_area(lmp_vec3 position, int lane, trace_rays *rays);

#endif
