/* SPDX-License-Identifier: MIT */
/* surface.h - the surface at a ray's hit: the material at a point of a triangle
 * (shaders/program/surface.frag does the same). */
#ifndef LAMPION_RENDER_CPU_SURFACE_H
#define LAMPION_RENDER_CPU_SURFACE_H

#include "app/render/cpu/shared.h"
#include "app/render/cpu/texture.h"
#include "app/render/surfaces.h"
#include "app/scene/instance.h"
#include "app/scene/trace/trace.h"

/* A triangle in the world and its material; zero: none. */
typedef struct cpu_triangle {
    uint32_t instance, triangle, number; /* number: of the material */
    const scene_material *material;
    bool mapped, read[2]; /* whether it has maps; which of the two sets of coordinates they use */
    scene_vertex corners[3];
    lmp_vec3 edges[2], face; /* from the first corner; their cross product */
    lmp_vec3 slope[2][2];    /* of the used coordinates, along the plane */
} cpu_triangle;

/* Prepares the triangle of a hit, unless *triangle is that already: neighbors often hit the
 * same. */
void cpu_triangle_find(const scene *scene, const trace_hit *hit, cpu_triangle *triangle);

/* Returns where a hit lies on its triangle: the position that cpu_surface_fill sets. */
lmp_vec3 cpu_surface_position(const cpu_triangle *triangle, const trace_hit *hit);

/* Fills value `at` of the surfaces' planes with the surface at the hit, or with that of the first
 * sample if it may stand for it; `first` may be NULL. */
void cpu_surface_fill(const cpu_textures *textures, const cpu_triangle *triangle,
                      const float direction[3], const trace_hit *hit, const cpu_first *first,
                      size_t at, const render_surfaces *surfaces);

#endif
