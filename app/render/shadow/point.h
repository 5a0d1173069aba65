/* SPDX-License-Identifier: MIT */
/* point.h - surface points side by side, from which the rays of neighboring pixels start. */
#ifndef LAMPION_RENDER_SHADOW_POINT_H
#define LAMPION_RENDER_SHADOW_POINT_H

#include "app/render/surfaces.h"
#include "app/scene/trace/trace.h"

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
    bool lit[SHADOW_LANES]; /* whether there is a point; the other members mean nothing elsewhere */
    shadow_vectors position, normal, view, mirror;
    shadow_vectors origin;  /* of the rays */
    shadow_vectors smooth;  /* the normal without its map */
    shadow_lanes footprint; /* the width of a pixel at the point */
    /* Metallic-roughness parameters, and the diffuse and specular reflectances of any material. */
    shadow_vectors diffuse, f0;
    shadow_lanes f90, alpha2, albedo, shine;
    /* Clear coats: their parameters and normals. */
    bool coated; /* whether any point has a coat */
    shadow_lanes coat, coat_alpha2;
    shadow_vectors coat_normal, coat_mirror;
    bool translucent;                   /* whether any point is translucent */
    shadow_vectors transmitted, behind; /* color of light from behind; origin of its rays */
    shadow_lanes through;               /* mean of the transmitted color */
    shadow_lanes ambient; /* fraction of the environment's light that arrives: the occlusion map */
    const lmp_material *material[SHADOW_LANES];
    const lmp_shade_settings *settings;
} shadow_points;

/* What is needed to find the points. */
typedef struct shadow_view {
    const scene *scene;
    const trace_bvh *bvh;
    float lift; /* of rays off their surface */
    const scene_camera *camera;
    float pixel; /* width of a pixel at distance 1 or, for a parallel camera, at any distance */
    lmp_shade_settings settings;
} shadow_view;

/* Returns the width of a tile's pixel on its surface. */
static inline float shadow_footprint(const shadow_view *view, const render_tile *tile, int pixel) {
    float d2 = 0;
    for (int c = 0; c < 3; c++) {
        const float d = tile->position[c][pixel] - view->camera->eye[c];
        d2 += d * d;
    }
    return view->pixel * (view->camera->height > 0 ? 1 : sqrtf(d2));
}

/* Finds the points of `count` pixels of the tile, at most SHADOW_LANES, all of which see a surface;
 * missing lanes repeat the first pixel. `hits` are their triangles, or NULL to find these by rays
 * along the views. */
void shadow_points_set(const shadow_view *view, const render_tile *tile, const trace_hit *hits,
                       const int *pixels, int count, shadow_points *points);

/* Returns the origin of the ray from a lane's point in a direction: on the back for light from
 * behind. */
lmp_vec3 shadow_origin(const shadow_points *points, int lane, lmp_vec3 w);

/* Computes f cos(theta), red, green and blue, for light from a unit direction w at each point,
 * never negative: glTF's BRDF, but no sharper than the bands resolve; the series of tables; and
 * transmitted light. Results of lanes without a point are meaningless. */
void shadow_reflect(const shadow_points *points, const shadow_vectors *w, shadow_vectors *k);

#endif
