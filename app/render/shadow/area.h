/* SPDX-License-Identifier: MIT */
/* area.h - rays toward lights that are areas: to points spread evenly over them. */
#ifndef LAMPION_RENDER_SHADOW_AREA_H
#define LAMPION_RENDER_SHADOW_AREA_H

#include "app/scene/emitter.h"

/* Estimates, 0 … 1, the irradiance over pi of an area of radiance 1, on a surface that faces it,
 * from which `to` leads to its center; above 0 wherever the area shines. */
float shadow_area_power(const scene_emitter *area, lmp_vec3 to);

typedef struct shadow_area_sample {
    lmp_vec3 direction;
    float length;      /* of the ray */
    float size;        /* sine of the angular radius of a sphere around the area */
    float solid_angle; /* one over the density of the direction; 0 if no light comes from there */
} shadow_area_sample;

/* Samples a direction from a position to a point of the area, by the uniform numbers u and v. No
 * light comes from points that are turned away or not covered. */
shadow_area_sample shadow_area_draw(const scene_emitter *area, lmp_vec3 from, float u, float v);

#endif
