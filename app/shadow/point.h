/* SPDX-License-Identifier: MIT */
/* point.h - what the rays of some neighboring pixels leave from: surface points beside each other.
 */
#ifndef LAMPION_SHADOW_POINT_H
#define LAMPION_SHADOW_POINT_H

#include "app/gpu/gpu.h"
#include "app/trace/trace.h"

enum { SHADOW_LANES = TRACE_LANES };

typedef float shadow_lanes[SHADOW_LANES];
typedef struct shadow_vectors {
    shadow_lanes of[3];
} shadow_vectors;

typedef struct shadow_points {
    bool lit[SHADOW_LANES]; /* there is one; the rest means nothing elsewhere */
    shadow_vectors position, normal, view, mirror;
    shadow_vectors origin;  /* of rays */
    shadow_vectors smooth;  /* the normal without its map */
    shadow_lanes footprint; /* the width of a pixel there */
    /* Metallic-roughness, and how much of diffuse and specular light any material reflects. */
    shadow_vectors diffuse, f0;
    shadow_lanes f90, alpha2, albedo, shine;
    /* Clear coats: what they reflect, and how they lie. */
    bool coated; /* some of the points */
    shadow_lanes coat, coat_alpha2;
    shadow_vectors coat_normal, coat_mirror;
    shadow_lanes ambient; /* how much of the environment comes: the occlusion map */
    const lmp_material *material[SHADOW_LANES];
    const lmp_shade_settings *settings;
} shadow_points;

/* What points are found by. */
typedef struct shadow_view {
    const scene *scene;
    const trace_bvh *bvh;
    float lift; /* of rays off their surface */
    const scene_camera *camera;
    float pixel; /* how wide a pixel is at distance 1, or anywhere of a parallel camera */
    lmp_shade_settings settings;
} shadow_view;

/* How wide a pixel of the row is on its surface. */
float shadow_footprint(const shadow_view *view, const gpu_row *row, int x);

/* The points of `count` pixels of the row, at most SHADOW_LANES, all of which show a surface; the
 * first of `pixels` stands for those that are missing. */
void shadow_points_set(const shadow_view *view, const gpu_row *row, const int *pixels, int count,
                       shadow_points *points);

/* f_r cos(theta) of light from the unit direction w at one of the points, never negative: glTF's
 * own, but no sharper than the bands resolve; of tables, the series. */
lmp_rgb shadow_reflect(const shadow_points *points, int lane, lmp_vec3 w);

#endif
