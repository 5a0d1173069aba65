/* SPDX-License-Identifier: MIT */
/* point.h - what the rays of some neighboring pixels leave from: surface points beside each other.
 */
#ifndef LAMPION_SHADOW_POINT_H
#define LAMPION_SHADOW_POINT_H

#include "app/render/frame/surfaces.h"
#include "app/trace/trace.h"

enum { SHADOW_LANES = TRACE_LANES };

typedef float shadow_lanes[SHADOW_LANES];
typedef struct shadow_vectors {
    shadow_lanes of[3];
} shadow_vectors;

static inline lmp_vec3 shadow_lane(const shadow_vectors *v, int lane) {
    return (lmp_vec3) { v->of[0][lane], v->of[1][lane], v->of[2][lane] };
}

static inline void shadow_set_lane(shadow_vectors *v, int lane, lmp_vec3 value) {
    v->of[0][lane] = value.x;
    v->of[1][lane] = value.y;
    v->of[2][lane] = value.z;
}

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

/* How wide a pixel of the tile is on its surface. */
float shadow_footprint(const shadow_view *view, const render_tile *tile, int pixel);

/* The points of `count` pixels of the tile, at most SHADOW_LANES, all of which show a surface; the
 * first of `pixels` stands for those that are missing. `hits` are their triangles, or NULL: then
 * rays along the views find them. */
void shadow_points_set(const shadow_view *view, const render_tile *tile, const trace_hit *hits,
                       const int *pixels, int count, shadow_points *points);

/* f_r cos(theta), red, green and blue, of light from a unit direction w at each of the points,
 * never negative: glTF's own, but no sharper than the bands resolve; of tables, the series. Of
 * points that are not lit it is nonsense. */
void shadow_reflect(const shadow_points *points, const shadow_vectors *w, shadow_vectors *k);

#endif
