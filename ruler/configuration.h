/* SPDX-License-Identifier: MIT */
/* configuration.h - what the ruler computes: one light, one material, one view. Every number is an
 * integer, so that a row of the table says exactly what was computed. */
#ifndef LAMPION_RULER_CONFIGURATION_H
#define LAMPION_RULER_CONFIGURATION_H

#include <stdbool.h>
#include <stdio.h>

typedef enum ruler_light {
    RULER_SPHERE,     /* size: radius over distance; touching or containing from 1 on */
    RULER_SUN,        /* size: half angle in degrees, up to 180 */
    RULER_HEMISPHERE, /* radiance 1 around an axis, RULER_GROUND in the other half */
    RULER_POINT,      /* irradiance 1 across its direction */
    RULER_SPOT,       /* a point; size: angle in degrees between its axis and the surface point */
    RULER_LIGHTS
} ruler_light;

/* The radiance of the hemisphere light's lower half, and the spot light's cone as
 * KHR_lights_punctual defines it. */
#define RULER_GROUND_HUNDREDTHS  25
#define RULER_SPOT_INNER_DEGREES 20
#define RULER_SPOT_OUTER_DEGREES 40

typedef enum ruler_material {
    RULER_LAMBERT,    /* color/pi */
    RULER_PHONG,      /* color (e+1)/(2 pi) max(r·w, 0)^e, r the mirror direction; no horizon */
    RULER_METAL,      /* glTF 2.0, appendix B: metallic 1 */
    RULER_DIELECTRIC, /* metallic 0 */
    RULER_MATERIALS
} ruler_material;

extern const char *const ruler_light_names[RULER_LIGHTS];
extern const char *const ruler_material_names[RULER_MATERIALS];

typedef struct ruler_configuration {
    int id;
    ruler_light light;
    int size;          /* in thousandths */
    int light_angle;   /* from the normal, hundredths of a degree */
    int light_azimuth; /* from the side of the mirror direction, hundredths of a degree */
    int view_angle;    /* from the normal, hundredths of a degree */
    ruler_material material;
    int color;     /* hundredths; one channel */
    int roughness; /* in thousandths; glTF's, of which alpha is the square */
    int exponent;  /* of phong */
} ruler_configuration;

int ruler_configuration_count(void);

/* Returns configuration 1 … ruler_configuration_count(): a low-discrepancy sequence for each
 * material, then corners chosen by hand. */
ruler_configuration ruler_configuration_at(int id);

#define RULER_CONFIGURATION_COLUMNS                                                                \
    "id,light,size,light_angle,light_azimuth,view_angle,material,color,roughness,exponent"
void ruler_configuration_print(FILE *stream, const ruler_configuration *configuration);

#endif
