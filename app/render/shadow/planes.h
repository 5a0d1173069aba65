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
    SHADOW_WEIGHT = 6, /* mean of SHADOW_ALL's channels */
    SHADOW_SLOPE = 7,  /* blocked light, divided by the width of its penumbra */
    SHADOW_HIDDEN = 8, /* blocked light, mean of the channels */
    SHADOW_VALUES
};

/* Shadows of lights and of the environment are filtered apart: the edges of the former would keep
 * the latter, which are soft, noisy. */
enum { SHADOW_SETS = 2 };

typedef struct shadow_planes {
    int width, height;
    int sets; /* of values: of lights and of the environment, or of either */
    float *memory;
    float *position[3], *normal[3]; /* the normal is 0 where there is no surface */
    float *footprint;               /* the width of a pixel on the surface */
    float *values[SHADOW_SETS][SHADOW_VALUES];
    float *scratch[SHADOW_VALUES]; /* of the filter */
} shadow_planes;

/* Allocates planes of that size and so many sets of values, replacing what was there. Returns false
 * if memory ran out. */
bool shadow_planes_resize(shadow_planes *planes, int width, int height, int sets);
void shadow_planes_free(shadow_planes *planes);

/* Returns the sum of a pixel's values number `value` over the sets. */
static inline float shadow_planes_sum(const shadow_planes *p, int value, size_t pixel) {
    float sum = p->values[0][value][pixel];
    for (int set = 1; set < p->sets; set++)
        sum += p->values[set][value][pixel];
    return sum;
}

/* Filters the values of neighbors on the same surface as widely as shadows are smooth; a larger
 * `narrowing`, about the square of a factor on distances, narrows it. One pixel in `spacing` of a
 * row has values, or all have. */
void shadow_filter(shadow_planes *planes, int spacing, float narrowing);

#endif
