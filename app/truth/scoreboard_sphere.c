/* SPDX-License-Identifier: MIT */
/* Lagarde and de Rousiers, Moving Frostbite to Physically Based Rendering (SIGGRAPH 2014 course
 * notes), section 4.7.2: the irradiance of a sphere or disk in closed form, with the horizon. */
#include "app/truth/scoreboard_gltf.h"

/* Evaluates the closed form; cosine is that between the light's direction and the normal. */
float gltf_sphere(float cosine, float sin2) {
    if (cosine * cosine > sin2)
        return sin2 * fmaxf(cosine, 0);
    const float sine = sqrtf(1 - cosine * cosine), x = sqrtf(1 / sin2 - 1);
    const float y = fminf(fmaxf(-x * cosine / sine, -1), 1);
    const float edge = sine * sqrtf(1 - y * y);
    const float irradiance = (cosine * acosf(y) - x * edge) * sin2 + atanf(edge / x);
    return fmaxf(irradiance, 0) / PI;
}

float formula_sphere(const formula_query *q, const formula_reads *reads) {
    (void)reads;
    return q->color * gltf_sphere(vec_dot(q->normal, q->light), q->sine * q->sine);
}
