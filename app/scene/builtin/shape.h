/* SPDX-License-Identifier: MIT */
/* shape.h - the solids that the built-in scenes are made of: boxes, solids of revolution and swept
 * mouldings. */
#ifndef LAMPION_SCENE_BUILTIN_SHAPE_H
#define LAMPION_SCENE_BUILTIN_SHAPE_H

#include "app/scene/builder.h"

#define SHAPE_MATERIALS_MAX 32

/* Where shapes are added: triangles are sorted by material and become one mesh per material. Shapes
 * are given in a local frame: rotated by `quarters` of 90° around y, then moved to `origin`. */
typedef struct scene_shaper {
    scene_builder *builder;
    builder_array triangles[SHAPE_MATERIALS_MAX]; /* uint32_t indices */
    uint32_t material;                            /* of the shapes that follow */
    int quarters;
    lmp_vec3 origin;
    int detail; /* percent of their steps that curves have, 0: all; columns with fewer are smooth */
} scene_shaper;

/* Returns how many of so many steps along a curve the shaper makes. */
int shaper_steps(const scene_shaper *shaper, int steps);

/* Appends the meshes to the builder, named after their materials, and frees the shaper. */
void shaper_finish(scene_shaper *shaper);

/* A point of a profile: distance from the axis (or depth), and position along it (or height). */
typedef struct shape_point {
    float r, a;
} shape_point;

/* Adds a quad a b c d, counter-clockwise seen from its front. */
void shape_quad(scene_shaper *shaper, lmp_vec3 a, lmp_vec3 b, lmp_vec3 c, lmp_vec3 d);

/* Adds a quad with a normal at each corner, counter-clockwise seen from its front. */
void shape_quad_smooth(scene_shaper *shaper, const lmp_vec3 corners[4], const lmp_vec3 normals[4]);

void shape_box(scene_shaper *shaper, lmp_vec3 minimum, lmp_vec3 maximum);

/* A surface of revolution, or a part of one. */
typedef struct shape_revolution {
    const shape_point *profile; /* edges that bend by less than 50° are smooth */
    int point_count;
    lmp_vec3 origin;
    char axis;      /* 'x', 'y' or 'z' */
    float from, to; /* angles; both 0: a full turn */
    int segments;   /* around the axis */
    int flutes;     /* 0, or the number of hollows around the axis */
    float depth;    /* of a flute, relative to the radius */
} shape_revolution;

/* Adds a surface of revolution. Its outside is to the right of the profile's direction in the (r,
 * a) plane. */
void shape_revolve(scene_shaper *shaper, const shape_revolution *revolution);

/* Sweeps a profile of (depth towards +z, height) along x; its outside is as in shape_revolve. */
void shape_sweep(scene_shaper *shaper, const shape_point *profile, int point_count, lmp_vec3 origin,
                 float from_x, float to_x);

#endif
