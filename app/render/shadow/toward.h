/* SPDX-License-Identifier: MIT */
/* toward.h - directions to an environment from a surface: what is bright in an even one is not what
 * a surface reflects most, and what it reflects most may be dark under a sun, so they are drawn by
 * both (multiple importance sampling, the balance heuristic of Veach and Guibas 1995). */
#ifndef LAMPION_SHADOW_TOWARD_H
#define LAMPION_SHADOW_TOWARD_H

#include "app/render/shadow/around.h"
#include "app/render/shadow/point.h"

/* The direction for two uniform numbers, as the point of a lane may reflect it, and what arrives
 * from there, with the density of both. */
lmp_vec3 shadow_draw_toward(const shadow_around *around, const shadow_points *points, int lane,
                            float u, float v, shadow_arrival *arrival);

#endif
