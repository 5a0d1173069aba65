/* SPDX-License-Identifier: MIT */
/* surface.h - what a ray's hit shows: the material of a point of a triangle (shaders/surface.frag
 * does the same). */
#ifndef LAMPION_CPU_SURFACE_H
#define LAMPION_CPU_SURFACE_H

#include "app/render/cpu/texture.h"
#include "app/render/frame/surfaces.h"
#include "app/trace/trace.h"

typedef struct cpu_ray {
    float origin[3], direction[3]; /* 1 long along the camera's view */
} cpu_ray;

/* Fills value `at` of the surfaces' planes. */
void cpu_surface_fill(const scene *scene, const cpu_textures *textures, const cpu_ray *ray,
                      const trace_hit *hit, size_t at, const render_surfaces *surfaces);

#endif
