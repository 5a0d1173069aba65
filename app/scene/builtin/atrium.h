/* SPDX-License-Identifier: MIT */
/* atrium.h - what the files of builtin:atrium share: its plan, its stones, and the parts that each
 * file makes. Meters, y up; the court runs along z. */
#ifndef LAMPION_SCENE_BUILTIN_ATRIUM_H
#define LAMPION_SCENE_BUILTIN_ATRIUM_H

#include "app/scene/builtin/builtin.h"
#include "app/scene/builtin/shape.h"

#define BAY         3.0f /* from column to column */
#define BAYS_LONG   8    /* along the court, times the parameter tiles */
#define BAYS_ACROSS 3
#define HALF_WIDTH  (0.5f * BAY * BAYS_ACROSS)
#define WALL        0.3f /* half the arcade's thickness */
#define AISLE       3.2f /* from the arcade's plane to the outer wall */
#define GALLERY     5.0f /* height of the upper floor */
#define CORNICE     9.3f /* where the vault springs */

/* A storey: heights above its floor. */
typedef struct storey_plan {
    float floor, springing, top; /* of the arches, and of the wall over them */
    float opening;               /* half the width of an arch */
} storey_plan;

extern const storey_plan atrium_lower, atrium_upper;

typedef enum stone {
    LIMESTONE, /* walls and arches */
    MARBLE,    /* columns */
    TRIM,      /* mouldings */
    PLASTER,   /* vaults */
    FRESCO,    /* blind arches */
    DADO,
    BRONZE, /* lanterns */
    BALUSTER,
    TERRACOTTA,
    GROUT,
    TILE_LIGHT, /* tiles, in four degrees of gloss each */
    TILE_DARK = TILE_LIGHT + 4,
    TILE_ACCENT = TILE_DARK + 4,
    STONES
} stone;

typedef struct court_plan {
    scene_shaper shaper;
    int bays; /* along z */
    float half_length;
    uint64_t random;
} court_plan;

/* Adds a solid of revolution around the vertical through `origin`. */
void atrium_revolve(scene_shaper *shaper, const shape_point *profile, int point_count,
                    lmp_vec3 origin, int segments);

/* Adds half of a solid of revolution around the z axis at height y: an arch. */
void atrium_revolve_arch(scene_shaper *shaper, const shape_point *profile, int point_count, float y,
                         int segments);

/* Returns the height of a groin vault over the springing of a storey. */
float atrium_vault_rise(const storey_plan *s);

/* atrium_arcade.c: the parts that face the court in one bay, except its floors. */
void atrium_put_column(scene_shaper *shaper, lmp_vec3 foot, float radius, float height, int flutes);
void atrium_put_arcade(scene_shaper *shaper);

/* atrium_bay.c: the bays on all four sides, with the aisles behind them. */
void atrium_put_bays(court_plan *court);

/* atrium_court.c: the court's floor, its vault and the ends of the vault. */
void atrium_put_court(court_plan *court);

/* atrium_lanterns.c: large lanterns, and strings of small ones. */
void atrium_hang_lanterns(court_plan *court, int count);

#endif
