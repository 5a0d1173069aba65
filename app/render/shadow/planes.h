/* SPDX-License-Identifier: MIT */
/* planes.h - planes of floats with what the shadows of an image's pixels are computed from. */
#ifndef LAMPION_RENDER_SHADOW_PLANES_H
#define LAMPION_RENDER_SHADOW_PLANES_H

#include <stdbool.h>
#include <stddef.h>

/* Sums over rays, relative to the pixel's estimated light, so that bright and dark pixels count
 * alike. */
enum {
    SHADOW_UNHIDDEN,   /* red, green, blue of what arrives and is reflected: the numerator */
    SHADOW_ALL = 3,    /* red, green, blue of what would be unblocked: the denominator */
    SHADOW_SLOPE = 6,  /* blocked light, divided by the width of its penumbra */
    SHADOW_HIDDEN = 7, /* blocked light, mean of the channels */
    SHADOW_WEIGHT = 8, /* mean of SHADOW_ALL's channels */
    SHADOW_VALUES
};

typedef struct shadow_planes {
    int width, height;
    float *memory;
    float *position[3], *normal[3]; /* the normal is 0 where there is no surface */
    float *footprint;               /* the width of a pixel on the surface */
    float *values[SHADOW_VALUES];
    float *scratch[SHADOW_VALUES]; /* of the filter */
} shadow_planes;

/* Allocates planes of that size, replacing what was there. Returns false if memory ran out. */
bool shadow_planes_resize(shadow_planes *planes, int width, int height);
void shadow_planes_free(shadow_planes *planes);

/* Filters the values of neighbors on the same surface as widely as shadows are smooth; a larger
 * `narrowing`, about the square of a factor on distances, narrows it. One pixel in `spacing` of a
 * row has values, or all have. */
void shadow_filter(shadow_planes *planes, int spacing, float narrowing);

#endif
