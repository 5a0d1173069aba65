/* SPDX-License-Identifier: MIT */
/* planes.h - what is known of an image's pixels before the shadow is: planes of floats. */
#ifndef LAMPION_SHADOW_PLANES_H
#define LAMPION_SHADOW_PLANES_H

#include <stdbool.h>
#include <stddef.h>

/* Sums over rays, in parts of what the pixel is guessed to get, so that bright and dark ones count
 * alike. */
enum {
    SHADOW_UNHIDDEN,   /* red, green, blue of what arrives and is reflected: the numerator */
    SHADOW_ALL = 3,    /* of what would be: the denominator */
    SHADOW_SLOPE = 6,  /* what is hidden, by the width of its penumbra */
    SHADOW_HIDDEN = 7, /* what is hidden, the mean of the colors */
    SHADOW_WEIGHT = 8, /* the mean of SHADOW_ALL */
    SHADOW_VALUES
};

typedef struct shadow_planes {
    int width, height;
    float *memory;
    float *position[3], *normal[3]; /* the normal is 0 where there is no surface */
    float *footprint;               /* the width of a pixel there */
    float *values[SHADOW_VALUES];
    float *scratch[SHADOW_VALUES]; /* of the filter */
} shadow_planes;

/* Of another size, in place of what was there. False without memory. */
bool shadow_planes_resize(shadow_planes *planes, int width, int height);
void shadow_planes_free(shadow_planes *planes);

/* Mixes the values of neighbors on one surface, as far as shadows are even, and the less far the
 * larger `narrowing` is, which is about the square of a factor on distances. Of `spacing` pixels of
 * a row one has values, or all. */
void shadow_filter(shadow_planes *planes, int spacing, float narrowing);

#endif
