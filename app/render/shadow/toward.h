/* SPDX-License-Identifier: MIT */
/* toward.h - directions to an environment, sampled at a surface by two strategies: bright
 * directions may be ones that the surface hardly reflects, and those that it reflects most may be
 * dark beside a sun (multiple importance sampling, the balance heuristic of Veach and Guibas
 * 1995). */
#ifndef LAMPION_RENDER_SHADOW_TOWARD_H
#define LAMPION_RENDER_SHADOW_TOWARD_H

#include "app/render/shadow/around.h"
#include "app/render/shadow/point.h"

/* Samples a direction that the point of a lane may reflect, from two uniform numbers; *arrival is
 * its radiance, and the density of all strategies. */
lmp_vec3 shadow_draw_toward(const shadow_around *around, const shadow_points *points, int lane,
                            float u, float v, shadow_arrival *arrival);

#endif
