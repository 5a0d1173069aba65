/* SPDX-License-Identifier: MIT */
/* toward.h - directions to an environment from a surface: what is bright in an even one is not what
 * a surface reflects most, and what it reflects most may be dark under a sun, so they are drawn by
 * both (multiple importance sampling, the balance heuristic of Veach and Guibas 1995). */
#ifndef LAMPION_SHADOW_TOWARD_H
#define LAMPION_SHADOW_TOWARD_H

#include "app/render/shadow/around.h"
#include "app/render/shadow/point.h"
#include "app/scene/vector.h"

/* The direction for two uniform numbers, as the point of a lane may reflect it; *arrives is its
 * radiance over its density. */
lmp_vec3 shadow_draw_toward(const shadow_around *around, const shadow_points *points, int lane,
                            float u, float v, lmp_rgb *arrives);

/* Of an angle in parts of a circle, 0 … 1, within 4e-7: by their series in the eighth of a circle
 * on either side of the nearest quarter. */
static inline void shadow_sine_cosine(float part, float *sine, float *cosine) {
    const int quarter = (int)(4 * part + 0.5f);
    const float x = (4 * part - (float)quarter) * (PI / 2), x2 = x * x;
    const float s = x * (1 - x2 / 6 * (1 - x2 / 20 * (1 - x2 / 42)));
    const float c = 1 - x2 / 2 * (1 - x2 / 12 * (1 - x2 / 30 * (1 - x2 / 56)));
    const float up = quarter & 1 ? c : s, right = quarter & 1 ? s : c;
    *sine = quarter & 2 ? -up : up;
    *cosine = (quarter + 1) & 2 ? -right : right;
}

#endif
