/* SPDX-License-Identifier: MIT */
/* surface.h - what a ray's hit shows: the material of a point of a triangle (shaders/surface.frag
 * does the same). */
#ifndef LAMPION_CPU_SURFACE_H
#define LAMPION_CPU_SURFACE_H

#include "app/render/cpu/shared.h"
#include "app/render/cpu/texture.h"
#include "app/render/frame/surfaces.h"
#include "app/scene/instance.h"
#include "app/trace/trace.h"

/* A triangle in the world and its material; zero: none yet. */
typedef struct cpu_triangle {
    uint32_t instance, triangle, number; /* number: of the material */
    const scene_material *material;
    bool mapped, read[2]; /* it has maps; which of the two sets of coordinates they read */
    scene_vertex corners[3];
    lmp_vec3 edges[2], face; /* from the first corner; across both */
    lmp_vec3 slope[2][2];    /* of the coordinates that are read, along the plane */
} cpu_triangle;

/* That of a hit, unless it is there: neighbors often meet the same. */
void cpu_triangle_find(const scene *scene, const trace_hit *hit, cpu_triangle *triangle);

/* Fills value `at` of the surfaces' planes with what the ray meets of the triangle, or with what an
 * earlier sample has found there, if that may stand for it; `first` may be NULL. */
void cpu_surface_fill(const cpu_textures *textures, const cpu_triangle *triangle,
                      const float direction[3], const trace_hit *hit, const cpu_first *first,
                      size_t at, const render_surfaces *surfaces);

#endif
