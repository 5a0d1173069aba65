/* SPDX-License-Identifier: MIT */
/* source.h - a light as caps and single directions, and where it is from a lobe's pole. */
#ifndef LAMPION_RULER_SOURCE_H
#define LAMPION_RULER_SOURCE_H

#include "ruler/configuration.h"
#include "ruler/domain.h"

typedef struct ruler_source {
    bool single;       /* a direction of irradiance `strength`; otherwise a cap of that radiance */
    ruler_angle angle; /* half angle of the cap */
    arb_t strength;
} ruler_source;
#define RULER_SOURCES 2

/* Finds the sources of a light and returns how many there are; each must then be cleared. */
int ruler_sources(const ruler_configuration *configuration, ruler_source parts[RULER_SOURCES]);
void ruler_source_clear(ruler_source *source);

/* Finds the angle between the light and the pole: the mirror direction of a Phong lobe, else the
 * normal. */
typedef struct ruler_pole {
    ruler_angle light;
} ruler_pole;
void ruler_pole_init(ruler_pole *pole);
void ruler_pole_clear(ruler_pole *pole);
void ruler_pole_set(ruler_pole *pole, const ruler_configuration *configuration);

#endif
